// Whether anything on the page lies over anything else.

/** What lies over something else, in words. */
export const covered = (browser) =>
  browser.value(`(() => {
    const found = [];
    const place = (selector) => document.querySelector(selector).getBoundingClientRect();
    const shown = (selector) => [...document.querySelectorAll(selector)].filter((part) => part.getClientRects().length);
    const blocks = ["header", "#boards", "#mind", "#felt", ".stage", ".time", ".beside"].filter((block) => shown(block).length);
    blocks.forEach((one, at) => blocks.slice(at + 1).forEach((other) => {
      const [a, b] = [place(one), place(other)];
      const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (across > 0.5 && down > 0.5) found.push(one + " and " + other + " share " + Math.round(down) + " px");
    }));
    const stage = place(".stage");
    for (const part of shown(".stage > *")) {
      const { top, bottom } = part.getBoundingClientRect();
      if (top < stage.top || bottom > stage.bottom + 0.5) found.push((part.id || part.className) + " leaves the stage");
    }
    for (const part of shown(".time :is(button, input, select, canvas)")) {
      part.scrollIntoView({ block: "center" });
      const { left, top, width, height } = part.getBoundingClientRect();
      for (const [x, y] of [[0.1, 0.1], [0.5, 0.5], [0.9, 0.9]]) {
        const seen = document.elementFromPoint(left + x * width, top + y * height);
        if (!seen?.closest(".time")) found.push(part.id + " is under " + (seen?.id || seen?.className));
      }
    }
    return found;
  })()`);
