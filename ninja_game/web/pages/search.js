// The search above a list: shows what has all the words, and sorts. Without it the list is whole.
"use strict";

// The game was the first page of a site once: links from that time lead there still.
const play = document.querySelector("main > p:first-child > a[href='play.html']");
if (play && /^#(level|pack|replay|watch)=/.test(location.hash)) location.replace(play.href + location.hash);

for (const form of document.querySelectorAll("form.search")) {
  const list = form.nextElementSibling;
  const items = Array.from(list.children);
  const found = form.querySelector(".found");
  const value = (name) => (form.elements[name] ? form.elements[name].value : "");

  const key = (item, by) => {
    const text = item.dataset[by];
    if (by === "name") return text || "";
    return text === undefined ? Infinity : Number(text);
  };

  const arrange = () => {
    const words = value("words").toLocaleLowerCase().split(/\s+/).filter(Boolean);
    const episode = value("episode");
    const by = value("sort") || "place";
    let count = 0;
    for (const item of items) {
      const fits = words.every((word) => item.dataset.words.includes(word));
      item.hidden = !fits || (episode !== "" && item.dataset.episode !== episode);
      count += item.hidden ? 0 : 1;
    }
    const less = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
    items.sort((a, b) => less(key(a, by), key(b, by)) || key(a, "place") - key(b, "place"));
    list.append(...items);
    found.textContent = count === items.length ? `${count} shown` : `${count} of ${items.length} shown`;
  };

  form.addEventListener("input", arrange);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.hidden = false;
  arrange();
}
