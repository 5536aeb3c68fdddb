// What lies over the branches: measured points, chaotic motions and their sections.

import assert from "node:assert/strict";
import { test } from "node:test";

import { drawn, open, options, rich } from "./shared.mjs";

const INK = "#222222";

/** Moves the pointer to a place of the diagram; what stands beside it then. */
async function hover(tab, frequency, value) {
    const [x, y] = await tab.value(`hammerbeam.pointAt(${frequency}, ${value})`);
    await tab.mouse("mouseMoved", x, y, { button: "none" });
    return tab.value(`(() => { const tip = document.querySelector(".tip"); return tip.classList.contains("seen") ? tip.innerText : ""; })()`);
}

/** Whether a place of the diagram has the colour of a mark. */
const marked = (frequency, value) => `(() => {
    const canvas = document.querySelector(".response canvas");
    const box = canvas.getBoundingClientRect();
    const [x, y] = hammerbeam.pointAt(${frequency}, ${value});
    const density = canvas.width / box.width;
    const data = canvas.getContext("2d").getImageData((x - box.left) * density - 4, (y - box.top) * density - 4, 9, 9).data;
    let count = 0;
    for (let k = 0; k < data.length; k += 4) count += data[k + 3] > 200 && [0, 1, 2].every((channel) => Math.abs(data[k + channel] - parseInt("${INK}".slice(1, 3), 16)) < 60);
    return count;
})()`;

test("measured points are drawn by their kind, tell their numbers, and have switches that a link keeps", options, async () => {
    const tab = await open(rich);
    await drawn(tab);
    const [open24, full26] = [await tab.value(marked(24, 4)), await tab.value(marked(26, 6))];
    assert.ok(open24 > 10 && full26 > 1.4 * open24, `an outline has ${open24} pixels of ink, a full square ${full26}`);
    const words = await hover(tab, 24, 4);
    for (const part of ["Measured periodic, 1/2 subharmonic", "As measured 3.0000 mm at 22.00000 Hz", "Shifted 4.0000 mm at 24.00000 Hz", "too far", "points.csv"]) {
        assert.ok(words.includes(part), `${part} in ${words}`);
    }
    assert.ok((await hover(tab, 26, 6)).includes("Measured aperiodic"));
    assert.ok((await tab.value(`document.body.innerText`)).includes("behind a filter"));
    // A click on one that stands beside a solution means that.
    assert.ok((await hover(tab, 20.2, 11)).includes("Measured periodic"));
    await tab.click(...(await tab.value(`hammerbeam.pointAt(20.2, 11)`)));
    assert.equal(await tab.value(`hammerbeam.state().selected`), 10);
    // Off: neither drawn nor told; the other kind stays.
    await tab.value(`document.querySelector("[data-layer=periodic]").click()`);
    await drawn(tab);
    assert.equal(await tab.value(`document.querySelector("[data-layer=periodic]").getAttribute("aria-pressed")`), "false");
    await tab.until(`${marked(24, 4)} === 0`);
    assert.ok((await tab.value(marked(26, 6))) > 10);
    assert.ok(!(await hover(tab, 24, 4)).includes("Measured"));
    // Where they were measured.
    await tab.value(`(() => { const one = [...document.querySelectorAll("select")].find((two) => two.textContent.includes("as measured")); one.value = "plain"; one.dispatchEvent(new Event("change")); })()`);
    await drawn(tab);
    await tab.until(`${marked(26, 6)} === 0`);
    assert.ok((await tab.value(marked(25, 5))) > 10);
    assert.ok((await tab.value(marked(13, 9))) > 5, "what has no shifted place has a measured one");
    await tab.until(`location.hash.includes("off=periodic") && location.hash.includes("shifted=no")`);
    const again = await open(rich, await tab.value(`location.hash`));
    assert.deepEqual(await again.value(`[[...hammerbeam.state().off], hammerbeam.state().shifted]`), [["periodic"], false]);
    // Of another quantity nothing was measured.
    await again.press("q");
    await drawn(again);
    assert.ok(!(await hover(again, 25, 5)).includes("Measured"));
    assert.deepEqual([...tab.complaints, ...again.complaints], []);
});

test("a click on a chaotic range and keys open the nearest chaotic motion with its section", options, async () => {
    const tab = await open(rich);
    const section = () => tab.value(`hammerbeam.state().section`);
    const points = () => tab.value(`document.querySelector("#section").dataset.points`);
    const top = await tab.value(`(() => { const box = document.querySelector(".response .u-over").getBoundingClientRect(); return box.top; })()`);
    const strip = async (frequency) => {
        const [x] = await tab.value(`hammerbeam.pointAt(${frequency}, 1)`);
        await tab.click(x, top + 4);
    };
    assert.equal(await section(), 0);
    await strip(14.2);
    // That with the velocity, of two of the same frequency; the point that is not finite has no place.
    assert.deepEqual([await section(), await points()], [1, "200"]);
    assert.ok((await tab.value(`document.querySelector("#section").innerText`)).includes("0.2500 ± 0.010"));
    // The diagram stays where it is; where the section is out of sight that is told, with a way to it.
    const isInView = `(() => { const { top, bottom } = document.querySelector("#section").getBoundingClientRect(); return bottom > 100 && top < innerHeight - 200; })()`;
    assert.deepEqual([await tab.value(`scrollY`), await tab.value(isInView)], [0, false]);
    assert.ok((await tab.value(`document.querySelector(".said").innerText`)).includes("15.0000 Hz is open"));
    await tab.value(`document.querySelector(".said button").click()`);
    assert.equal(await tab.value(isInView), true);
    await tab.value(`scrollTo(0, 0)`);
    await strip(28);
    assert.deepEqual([await section(), await points()], [3, "50"]);
    await tab.value(`scrollTo(0, 0)`);
    // A free place within a range, and what is told there.
    assert.ok((await hover(tab, 15, 18)).includes("Chaotic motion 14.000 to 16.000 Hz"));
    await tab.click(...(await tab.value(`hammerbeam.pointAt(15, 18)`)));
    assert.equal(await section(), 1);
    for (const [key, place] of [[".", 2], [".", 3], [",", 2], [",", 1], [",", 3]]) {
        await tab.press(key);
        assert.equal(await section(), place);
    }
    await tab.press(",");
    const axis = await tab.value(`document.querySelector("#section").innerText`);
    assert.ok(axis.includes("sweep 2, up") && axis.includes("period before"), axis);
    // The motion of the sweep itself, and a solution, which a range does not hide.
    await tab.value(`scrollTo(0, 0)`);
    assert.ok((await hover(tab, 15, 12)).includes("chaotic"));
    await tab.click(...(await tab.value(`hammerbeam.pointAt(15, 6)`)));
    assert.equal(await tab.value(`hammerbeam.state().selected`), 5);
    // A range whose switch is off is no place to click on.
    await tab.value(`document.querySelector("[data-layer=chaos]").click()`);
    await drawn(tab);
    await strip(14.2);
    assert.equal(await section(), 2);
    // Its button shows it.
    await tab.value(`document.querySelector("#section .ranges button").click()`);
    const { x } = await tab.value(`hammerbeam.state().view`);
    assert.ok(x[0] > 13 && x[0] < 14 && x[1] > 16 && x[1] < 17, `${x}`);
    assert.equal(await section(), 1);
    assert.deepEqual(tab.complaints, []);
});
