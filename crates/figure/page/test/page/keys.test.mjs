// Keys, the wheel, and links to a state.

import assert from "node:assert/strict";
import { test } from "node:test";

import { drawn, meta, open, options, pages } from "./shared.mjs";

test("keys step along the branch, zoom and show the list of keys; the wheel zooms about the pointer", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    const state = () => tab.value(`(() => { const { selected, view, log } = hammerbeam.state(); return { selected, view, log }; })()`);
    const { selected, log } = await state();
    await tab.press("ArrowRight");
    assert.equal((await state()).selected, selected + 1);
    await tab.press("+");
    const zoomed = (await state()).view;
    assert.ok(zoomed.x[1] - zoomed.x[0] < 0.7 * (pages.run.range[1] - pages.run.range[0]));
    await tab.press("0");
    assert.equal((await state()).view, null);
    await tab.press("l");
    assert.equal((await state()).log, !log);
    const [x, y] = await tab.value(`hammerbeam.placeOf(${selected})`);
    await tab.mouse("mouseWheel", x, y, { deltaX: 0, deltaY: -300, button: "none" });
    await tab.until(`hammerbeam.state().view !== null`);
    await drawn(tab);
    const [stillX] = await tab.value(`hammerbeam.placeOf(${selected})`);
    assert.ok(Math.abs(stillX - x) < 1.5, `${stillX} ${x}`);
    await tab.press("?");
    assert.equal(await tab.value(`document.querySelector("dialog").open`), true);
    assert.deepEqual(tab.complaints, []);
});

test("keys stay on branches that are drawn and in the view, and work after a click into a list", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    const { branches } = await tab.value(meta);
    const selected = () => tab.value(`hammerbeam.state().selected`);
    const branchOf = (solution) => branches.findLastIndex(({ first, count }) => count > 0 && first <= solution);
    // All but the first and the last branch hidden.
    const hide = (place) => tab.value(`document.querySelectorAll("#branches input[type=checkbox]")[${place}].click()`);
    for (let place = 1; place + 1 < branches.length; place++) {
        await hide(place);
    }
    await tab.press("ArrowDown");
    assert.equal(branchOf(await selected()), branches.length - 1);
    await tab.press("ArrowDown");
    assert.equal(branchOf(await selected()), 0);
    // The view follows what steps out of it.
    const seen = async () => {
        const solution = await selected();
        await drawn(tab);
        const [x, y] = await tab.value(`hammerbeam.placeOf(${solution})`);
        const box = await tab.value(`(() => { const { left, right, top, bottom } = document.querySelector(".response .u-over").getBoundingClientRect(); return { left, right, top, bottom }; })()`);
        return x >= box.left - 1 && x <= box.right + 1 && y >= box.top - 1 && y <= box.bottom + 1;
    };
    await tab.value(`hammerbeam.zoom(0.02)`);
    for (let k = 0; k < 4; k++) {
        await tab.press("PageDown");
        assert.ok(await seen(), `out of the view after ${k + 1} steps`);
    }
    // A cell that is no button.
    const [x, y] = await tab.value(`(() => { const cell = document.querySelector("#branches tbody td:last-child"); cell.scrollIntoView(); const box = cell.getBoundingClientRect(); return [box.left + 3, box.top + 3]; })()`);
    await tab.click(x, y);
    const before = await selected();
    await tab.press("ArrowLeft");
    assert.equal(await selected(), before - 1);
    assert.deepEqual(tab.complaints, []);
});

test("a link that is typed while an earlier change waits for its place in the address is followed", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    const { branches } = await tab.value(meta);
    // The address is written at the end of the same task, before the browser tells of the link.
    await tab.value(`(() => {
        hammerbeam.zoom(0.5);
        location.hash = "#at=${pages.run.first_branch}:60&show=acceleration";
        [...document.querySelectorAll("button")].find((one) => one.textContent === "Copy link").click();
    })()`);
    await tab.until(`hammerbeam.state().quantity === "acceleration"`);
    const after = await tab.value(`hammerbeam.state()`);
    assert.deepEqual([after.selected, after.view], [branches[0].first + 60, null]);
    await tab.until(`location.hash.includes("show=acceleration") && location.hash.includes(":60")`);
    // The same with the timer of the change: the tab is busy until both it and the link are due.
    await tab.value(`(() => {
        hammerbeam.zoom(0.5);
        setTimeout(() => {
            location.hash = "#at=${pages.run.first_branch}:70";
            for (const end = performance.now() + 200; performance.now() < end;);
        }, 150);
    })()`);
    await tab.until(`hammerbeam.state().selected === ${branches[0].first + 70}`);
    await new Promise((resolve) => setTimeout(resolve, 400));
    assert.ok((await tab.value(`location.hash`)).includes(`at=${pages.run.first_branch}:70`));
    assert.deepEqual(tab.complaints, []);
});

test("a row of the bifurcation table jumps to its point", options, async () => {
    const tab = await open(pages.run);
    const solution = await tab.value(`(() => { const row = document.querySelectorAll("#bifurcations tbody tr")[2]; row.querySelector("button").click(); return +row.dataset.solution; })()`);
    assert.equal(await tab.value(`hammerbeam.state().selected`), solution);
    await drawn(tab);
    const [x] = await tab.value(`hammerbeam.placeOf(${solution})`);
    const box = await tab.value(`(() => { const { left, width } = document.querySelector(".response .u-over").getBoundingClientRect(); return { left, width }; })()`);
    assert.ok(Math.abs(x - box.left - box.width / 2) < 2, "in the middle of the view");
    assert.deepEqual(tab.complaints, []);
});

test("a link restores what was shown", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    await tab.press("+");
    await tab.press("+");
    await tab.press("m");
    await tab.value(`document.querySelector("#branches input[type=checkbox]").click()`);
    const shown = `(() => { const { hidden, ...rest } = hammerbeam.state(); return { ...rest, hidden: [...hidden] }; })()`;
    const state = await tab.value(shown);
    await tab.until(`location.hash.includes("hide=") && location.hash.includes("marks=off")`);
    const again = await open(pages.run, await tab.value(`location.hash`));
    const restored = await again.value(shown);
    const near = (a, b) => a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) < 1e-6 * (a[1] - a[0])));
    near(restored.view.x, state.view.x);
    near(restored.view.y, state.view.y);
    assert.deepEqual({ ...restored, view: null }, { ...state, view: null });
    assert.deepEqual(again.complaints, []);
});
