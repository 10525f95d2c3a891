// The robot of the page, as a test reads it.

/** What shows it. */
export const ROBOT = "taxel.views.body.onRobot";
/** A program with the reference garment on its robot. */
export const OPTIONS = ["--body", "reference", "--robot", "reference"];

/** Where a corner of the cloth is on the page, and whether it faces the viewer. */
export const cornerOf = (browser, taxel, side = 0) =>
  browser.value(`(() => {
    const { aspects, cloth, stage, standing } = ${ROBOT};
    const corner = cloth.taxels.indexOf(${taxel});
    const { left, top } = stage.getBoundingClientRect();
    const { seen, viewer } = aspects[${side}];
    const normal = [...standing.normals.slice(3 * corner, 3 * corner + 3)];
    return {
      x: seen[3 * corner] + left,
      y: seen[3 * corner + 1] + top,
      facing: normal.reduce((sum, part, axis) => sum + part * viewer[axis], 0),
    };
  })()`);

/** The tips of the arrows that are shown, on the page, and what stands beside them. */
export const arrows = (browser) =>
  browser.value(`[...${ROBOT}.forces.children].filter((group) => group.getAttribute("display") !== "none").map((group) => {
    const { left, top } = ${ROBOT}.stage.getBoundingClientRect();
    const [, x, y] = /L(\\S+) (\\S+?)M/.exec(group.children[0].getAttribute("d")).map(Number);
    return { x: x + left, y: y + top, text: group.children[2].textContent };
  })`);
