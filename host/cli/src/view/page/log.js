// The log: a line with a time leads to its moment.

import { make } from "./dom.js";

/** The list; `go` leads to a moment, us. */
export class Log {
  /**
   * @param {HTMLElement} list
   * @param {(at: number) => void} go
   */
  constructor(list, go) {
    this.list = list;
    list.addEventListener("click", (event) => {
      const link = event.target instanceof Element && event.target.closest("a");
      if (!link) return;
      event.preventDefault();
      go(Number(link.dataset.at));
    });
  }

  /**
   * Draws lines, the newest first; those that stay are left alone, so that one of them may have the focus.
   * @param {import("./types.d.ts").LogEntry[]} lines
   */
  draw(lines) {
    const { list } = this;
    const known = new Map([...list.children].map((item) => [item.getAttribute("data-key"), item]));
    lines.forEach(({ at, kind, said, leads }, index) => {
      const key = `${at} ${leads} ${said}`;
      const here = list.children[index] ?? null;
      if (here?.getAttribute("data-key") === key) return;
      list.insertBefore(known.get(key) ?? item({ at, kind, said, leads }, key), here);
    });
    while (list.children.length > lines.length) list.lastElementChild?.remove();
  }
}

/**
 * @param {import("./types.d.ts").LogEntry} line
 * @param {string} key
 */
function item({ at, kind, said, leads }, key) {
  const time = at === null ? "" : `${(at / 1e6).toFixed(3)} s `;
  const words = [make("span", { class: "quiet" }, time), said];
  const parts = leads && at !== null ? [make("a", { href: `#t=${(at / 1e6).toFixed(3)}`, "data-at": at }, ...words)] : words;
  return make("li", { "data-key": key, class: kind }, ...parts);
}
