// A message when something went wrong: what, with buttons that copy it and that load the page again.
import { build } from "./build.js";

const dialog = document.getElementById("trouble");

export function element(name, properties, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

export function button(label, action) {
  return element("button", { type: "button", textContent: label, onclick: action });
}

// What a Python error says, without where it came from.
export function lastLine(error) {
  const lines = String(error.message ?? error).trim().split("\n");
  return lines[lines.length - 1].replace(/^[\w.]*Error: /, "");
}

// The game stands still: why, what to do about it, buttons for that.
export function showStop(title, advice, ...parts) {
  dialog.replaceChildren(element("h2", { id: "trouble-title", textContent: title }), element("p", { textContent: advice }), ...parts);
  dialog.oncancel = (event) => event.preventDefault();
  if (!dialog.open) dialog.showModal();
}

export const reloading = (label) => button(label, () => location.reload());

// The same for anything thrown, with a text that can be copied.
export function showTrouble(error, title, advice) {
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
  showStop(title, advice, element("div", { className: "row" }, reloading("Load the page again"), copy), shown);
}
