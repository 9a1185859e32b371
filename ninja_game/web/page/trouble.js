// A message when something went wrong: what, with buttons that copy it and that load the page again.
import { build } from "./loading.js";

const dialog = document.getElementById("trouble");

function element(name, properties, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export function button(label, action) {
  return element("button", { type: "button", textContent: label, onclick: action });
}

export { element };

// What a Python error says, without where it came from.
export function lastLine(error) {
  const lines = String(error.message ?? error).trim().split("\n");
  return lines[lines.length - 1].replace(/^[\w.]*Error: /, "");
}

// `error`: anything thrown; `title` and `advice`: what to say above it.
export function showTrouble(error, title, advice, ...more) {
  const words = `${error?.message ?? error}\n\n${error?.name === "PythonError" ? "" : (error?.stack ?? "")}`.trim();
  const text = `ninja-game ${build.version} (${build.id})\n${navigator.userAgent}\n\n${words}`;
  const copy = button("Copy the text", async () => {
    try {
      await navigator.clipboard.writeText(text);
      copy.textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(shown);
      copy.textContent = "Selected: press Ctrl+C";
    }
  });
  const shown = element("pre", { textContent: text });
  dialog.replaceChildren(
    element("h2", { id: "trouble-title", textContent: title }),
    element("p", { textContent: advice }),
    element("div", { className: "row" }, button("Load the page again", () => location.reload()), copy, ...more),
    shown,
  );
  dialog.oncancel = (event) => event.preventDefault();
  if (!dialog.open) dialog.showModal();
}
