// The page in a real headless Chromium.
//
// The pages come from the test that runs this file (crates/cli/tests/page.rs), as HAMMERBEAM_PAGES: a JSON document with, for each page, its path, the number of its branches,
// and what is odd about it. Pictures are kept in HAMMERBEAM_PICTURES.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { pathToFileURL } from "node:url";

import { launch } from "./browser.mjs";

const pages = JSON.parse(process.env.HAMMERBEAM_PAGES ?? "{}");
const pictures = process.env.HAMMERBEAM_PICTURES ?? "";
const LIGHT = [{ name: "prefers-color-scheme", value: "light" }];
const DARK = [{ name: "prefers-color-scheme", value: "dark" }];

let browser = null;
let reason = pages.run === undefined ? "HAMMERBEAM_PAGES names no page: cargo test -p hammerbeam --test page runs this test" : "";
if (reason === "") {
    try {
        browser = await launch();
    } catch (error) {
        reason = `no browser: ${error.message}`;
        if (process.env.HAMMERBEAM_REQUIRE_BROWSER === "1") {
            throw new Error(reason);
        }
    }
}
const options = reason === "" ? {} : { skip: reason };
before(() => pictures !== "" && mkdirSync(pictures, { recursive: true }));
afterEach(() => browser?.closeTabs()); // what moves in them takes time
after(() => browser?.close());

/** The page with something of everything. */
const rich = pages.odd?.find(({ name }) => name === "everything at once");

/** Opens a page in a tab of its own. */
async function open(page, hash = "", { width = 1400, height = 1000, features = LIGHT } = {}) {
    const tab = await browser.tab(width, height, features);
    await tab.open(pathToFileURL(page.path).href + hash);
    return tab;
}

/** Waits until everything that was asked for is drawn. */
const drawn = (tab) => tab.value(`new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))))`);

const orbitIsOpen = `document.querySelector(".solution").dataset.orbit !== ""`;
/** Whether an element is seen. */
const isSeen = (selector) => `(() => { const one = document.querySelector(${JSON.stringify(selector)}); return one !== null && one.getClientRects().length > 0; })()`;
const motion = `(() => { const c = document.querySelector("#motion canvas"); return c.width + ":" + c.toDataURL(); })()`;
const meta = `JSON.parse(document.getElementById("meta").textContent)`;

/** Whether the diagram has a colour within some pixels of a solution. */
const coloured = (solution, colour) => `(() => {
    const canvas = document.querySelector(".response canvas");
    const box = canvas.getBoundingClientRect();
    const [x, y] = hammerbeam.placeOf(${solution});
    const density = canvas.width / box.width;
    const data = canvas.getContext("2d").getImageData((x - box.left) * density - 4, (y - box.top) * density - 4, 9, 9).data;
    const wanted = ["1,2", "3,4", "5,6"].map((part) => parseInt(${JSON.stringify(colour)}.slice(+part[0], +part[2] + 1), 16));
    for (let k = 0; k < data.length; k += 4) {
        if (wanted.every((value, channel) => Math.abs(value - data[k + channel]) < 60)) return true;
    }
    return false;
})()`;

test("the page opens without a complaint and draws every branch where its solutions are", options, async () => {
    const tab = await open(pages.run);
    assert.equal(await tab.value(`document.querySelector(".response").dataset.branches`), String(pages.run.branches));
    const { branches, look } = await tab.value(meta);
    assert.equal(branches.length, pages.run.branches);
    await tab.value(`document.querySelector(".controls input[type=checkbox]").click()`); // marks off
    await tab.until(`hammerbeam.state().marks === false`);
    await drawn(tab);
    for (const { first, count, period } of branches) {
        const colour = look.light.periods[(period - 1) % look.light.periods.length];
        const places = [0.3, 0.5, 0.7].map((share) => first + Math.floor(share * (count - 1)));
        const found = await Promise.all(places.map((solution) => tab.value(coloured(solution, colour))));
        assert.ok(found.some(Boolean), `branch at ${first} is not drawn in ${colour}`);
    }
    await tab.value(`[...document.querySelectorAll("#branches button")].find((one) => one.textContent === "none").click()`);
    await tab.until(`document.querySelector(".response").dataset.branches === "0"`);
    const middle = branches[0].first + (branches[0].count >> 1);
    assert.equal(await tab.value(coloured(middle, look.light.periods[0])), false);
    assert.deepEqual(tab.complaints, []);
});

test("a click opens the orbit of the solution, and its peaks are those of the store", options, async () => {
    const tab = await open(pages.run);
    const { orbits, branches } = await tab.value(meta);
    const wanted = orbits.solutions.filter((solution) => solution > branches[0].first + 50)[20];
    const [x, y] = await tab.value(`hammerbeam.placeOf(${wanted})`);
    await tab.click(x, y);
    await tab.until(orbitIsOpen);
    const selected = await tab.value(`hammerbeam.state().selected`);
    const [toX, toY] = await tab.value(`hammerbeam.placeOf(${selected})`);
    assert.ok(Math.hypot(toX - x, toY - y) <= 1.5, "the solution clicked on");
    await tab.value(`location.hash = "#at=${pages.run.first_branch}:${wanted - branches[0].first}"`);
    await tab.until(`document.querySelector(".solution").dataset.orbit === "${wanted}"`);
    const compared = await tab.value(`(() => {
        const orbit = hammerbeam.orbit();
        const most = (values) => Math.max(0, ...values.map(Math.abs));
        const numbers = [...document.querySelectorAll(".numbers dd")].map((one) => parseFloat(one.textContent.replace("−", "-")));
        const names = [...document.querySelectorAll(".numbers dt")].map((one) => one.textContent);
        const of = (name) => numbers[names.indexOf(name)];
        return {
            displacement: [1e3 * most([...orbit.displacement]), of("Max. displacement")],
            acceleration: [most([...orbit.acceleration]), of("Max. acceleration")],
            force: [Math.max(0, ...orbit.forces.map((force) => most([...force]))), of("Max. contact force")],
        };
    })()`);
    // 192 samples miss a peak by (pi/192)^2/2 = 1.3e-4 of it and more for higher harmonics; 24 in a contact by 2e-3.
    for (const [name, [found, stored]] of Object.entries(compared)) {
        assert.ok(Math.abs(found - stored) <= 0.01 * stored, `${name}: ${found} of ${stored}`);
    }
    if (pictures !== "") {
        writeFileSync(join(pictures, "page-light.png"), await tab.picture());
    }
    assert.deepEqual(tab.complaints, []);
});

test("multipliers are those of the selected solution, whether its orbit is carried or not", options, async () => {
    const tab = await open(pages.run);
    const { orbits, branches } = await tab.value(meta);
    const carried = new Set(orbits.solutions);
    const without = pages.run.multipliers.filter(({ solution }) => !carried.has(solution));
    assert.ok(without.length > 20);
    const near = (found, stored, tolerance) => Math.abs(found - stored) <= tolerance * Math.abs(stored);
    for (const { solution, stored } of pages.run.multipliers) {
        const found = await tab.value(`hammerbeam.multipliersOf(${solution})`);
        assert.equal(found.length, stored.length);
        const sorted = (all) => all.map(([re, im]) => [re, Math.abs(im)]);
        sorted(found).forEach(([re, im], k) => {
            const [storedRe, storedIm] = sorted(stored)[k];
            // An f32 without its lowest byte.
            assert.ok(near(re, storedRe, 2 ** -15) && near(im, storedIm, 2 ** -15), `${solution}: ${re} ${im} of ${stored[k]}`);
        });
    }
    // What is read on the page, of a solution whose orbit is not carried.
    const { solution, stored } = without[10];
    const place = branches.findLast(({ first, count }) => count > 0 && first <= solution);
    await tab.value(`location.hash = "#at=${place.id}:${solution - place.first}"`);
    await tab.until(`hammerbeam.state().selected === ${solution}`);
    const read = await tab.value(`[...document.querySelectorAll("#multipliers li")].map((one) => one.textContent)`);
    const parts = read[0].replaceAll("−", "-").replace("i", "").split(" ± ").map(Number);
    assert.ok(near(parts[0], stored[0][0], 1e-3) && near(parts[1] ?? 0, Math.abs(stored[0][1]), 1e-3), `${read[0]} of ${stored[0]}`);
    const whose = await tab.value(`document.querySelector("#multipliers .note").textContent`);
    assert.ok(whose.includes("of the selected solution, at "), whose);
    assert.deepEqual(tab.complaints, []);
});

test("the structure moves, and stands still when it is paused", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    await tab.until(orbitIsOpen);
    const first = await tab.value(motion);
    await tab.until(`${motion} !== ${JSON.stringify(first)}`);
    await tab.press(" ");
    await tab.until(`[...document.querySelectorAll("#motion button")].some((one) => one.textContent === "Play")`);
    await drawn(tab);
    const paused = await tab.value(motion);
    await new Promise((resolve) => setTimeout(resolve, 300));
    assert.ok((await tab.value(motion)) === paused);
    assert.deepEqual(tab.complaints, []);
});

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

test("the unit circle stays one when the window changes", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    await tab.until(orbitIsOpen);
    for (const width of [1400, 700, 1100, 420]) {
        await tab.send("Emulation.setDeviceMetricsOverride", { width, height: 900, deviceScaleFactor: 1, mobile: false });
        await drawn(tab);
        await drawn(tab);
        const [across, up] = await tab.value(`hammerbeam.unitCircle()`);
        assert.ok(up > 10 && Math.abs(across - up) < 1.5, `${across} across, ${up} up at ${width} pixels`);
    }
    assert.deepEqual(tab.complaints, []);
});

test("no corner is seen in the phase portraits of orbits of several periods", options, async () => {
    const { orbits, branches } = await (await open(pages.run)).value(meta);
    const several = branches.filter(({ period, count }) => period > 1 && count > 0);
    assert.ok(several.length > 0);
    for (const { id, first, count, period } of several) {
        const own = orbits.solutions.filter((solution) => solution >= first && solution < first + count);
        for (const solution of [own[0], own[own.length >> 1]]) {
            const tab = await open(pages.run, `#at=${id}:${solution - first}`);
            await tab.until(`document.querySelector(".solution").dataset.orbit === "${solution}"`);
            // How far the curve through three points leaves the line between two of them: an eighth of the second difference.
            const farthest = await tab.value(`(() => {
                const [displacement, velocity] = hammerbeam.orbit().portrait;
                const n = displacement.length;
                const width = (values) => Math.max(...values) - Math.min(...values);
                const bend = (values) => (k) => (values[k] - 2 * values[(k + 1) % n] + values[(k + 2) % n]) / width(values) / 8;
                const [across, up] = [bend(displacement), bend(velocity)];
                return Math.max(...Array.from({ length: n }, (_, k) => Math.hypot(across(k), up(k))));
            })()`);
            // Three pixels of a hundred; without the samples within contacts it is twelve.
            assert.ok(farthest < 0.03, `${farthest} of the size of the portrait of solution ${solution}, period ${period}`);
        }
    }
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

test("what is pressed or scrolled is not printed, what is shown is, on light paper that nothing juts out of", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100&theme=dark`, { features: DARK });
    await tab.until(orbitIsOpen);
    const shown = ["h1", ".response canvas", ".legend", "#selected", "#motion canvas", "#multipliers canvas", "#displacement canvas", "#spectrum canvas"];
    const pressed = [".controls", "#branches", "#bifurcations", "#figures"];
    const seen = (selectors) => Promise.all(selectors.map((selector) => tab.value(isSeen(selector))));
    assert.deepEqual(await seen([...shown, ...pressed]), [...shown, ...pressed].map(() => true));
    const brightness = `getComputedStyle(document.body).backgroundColor.match(/\\d+/g).slice(0, 3).reduce((sum, part) => sum + +part, 0)`;
    // As a browser announces that it prints; Page.printToPDF does it, too, but nothing can be asked then.
    await tab.value(`window.dispatchEvent(new Event("beforeprint"))`);
    await drawn(tab);
    assert.deepEqual(await seen(shown), shown.map(() => true));
    assert.deepEqual(await seen(pressed), pressed.map(() => false));
    assert.ok((await tab.value(brightness)) > 700);
    const juts = await tab.value(`(() => {
        // 186 mm of A4 between its margins.
        const right = document.querySelector("#page").getBoundingClientRect().left + (186 / 25.4) * 96;
        return [...document.querySelectorAll("canvas, img, p, dl, table")].filter((one) => one.getBoundingClientRect().right > right).map((one) => one.outerHTML.slice(0, 80));
    })()`);
    assert.deepEqual(juts, []);
    const cut = await tab.value(`[...document.querySelectorAll(".plot, .response")].filter((host) => host.querySelector("canvas")?.getBoundingClientRect().right > host.getBoundingClientRect().right + 1).length`);
    assert.equal(cut, 0, "canvases are as wide as their places");
    await tab.value(`document.querySelector("#figures details").open = true`);
    await tab.until(`document.querySelector("#figures img")?.naturalWidth > 0`);
    assert.equal(await tab.value(isSeen("#figures img")), true);
    await tab.value(`window.dispatchEvent(new Event("afterprint"))`);
    await drawn(tab);
    assert.deepEqual(await seen(pressed), pressed.map(() => true));
    assert.ok((await tab.value(brightness)) < 150);
    const { data } = await tab.send("Page.printToPDF", { paperWidth: 8.27, paperHeight: 11.69 });
    const pdf = Buffer.from(data, "base64");
    if (pictures !== "") {
        writeFileSync(join(pictures, "page.pdf"), pdf);
    }
    assert.deepEqual(tab.complaints, []);
});

test("printed figures are there, each under its heading, and are drawn when it is opened", options, async () => {
    const tab = await open(pages.run);
    const { carried } = (await tab.value(meta)).figures;
    assert.ok(carried.some(({ name }) => name === "structure") && carried.some(({ name }) => name === "modes"));
    assert.equal(await tab.value(`document.querySelectorAll("#figures img").length`), 0);
    await tab.value(`document.querySelectorAll("#figures details").forEach((one) => (one.open = true))`);
    await tab.until(`document.querySelectorAll("#figures img").length === ${carried.length}`);
    await tab.until(`[...document.querySelectorAll("#figures img")].every((one) => one.complete)`);
    const sizes = await tab.value(`[...document.querySelectorAll("#figures img")].map((one) => one.naturalWidth)`);
    assert.ok(sizes.every((width) => width > 100), `${sizes}`);
    assert.deepEqual(tab.complaints, []);
});

test("dark where the system is dark or the reader wants it, light on paper", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`, { features: DARK });
    const brightness = `getComputedStyle(document.body).backgroundColor.match(/\\d+/g).slice(0, 3).reduce((sum, part) => sum + +part, 0)`;
    assert.ok((await tab.value(brightness)) < 150);
    await tab.until(orbitIsOpen);
    await drawn(tab);
    if (pictures !== "") {
        writeFileSync(join(pictures, "page-dark.png"), await tab.picture());
    }
    await tab.send("Emulation.setEmulatedMedia", { media: "print", features: DARK });
    await tab.until(`${brightness} > 700`);
    assert.equal(await tab.value(`getComputedStyle(document.querySelector(".controls")).display`), "none");
    const { data } = await tab.send("Page.printToPDF", { landscape: true });
    assert.ok(Buffer.from(data, "base64").subarray(0, 4).equals(Buffer.from("%PDF")));
    await tab.send("Emulation.setEmulatedMedia", { media: "screen", features: DARK });
    await tab.until(`${brightness} < 150`);
    await tab.press("d");
    await tab.until(`${brightness} > 700`);
    assert.deepEqual(tab.complaints, []);
});

test("a narrow window needs no scrolling sideways", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`, { width: 400, height: 800 });
    await tab.until(orbitIsOpen);
    assert.equal(await tab.value(`document.documentElement.scrollWidth <= innerWidth`), true);
    const full = await open(rich, "", { width: 400, height: 800 });
    assert.equal(await full.value(`document.documentElement.scrollWidth <= innerWidth`), true);
    if (pictures !== "") {
        writeFileSync(join(pictures, "page-narrow.png"), await tab.picture());
    }
});

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
    for (const part of ["Measured periodic, period 2 (1/2)", "As measured 3.0000 mm at 22.00000 Hz", "Shifted 4.0000 mm at 24.00000 Hz", "too far", "points.csv"]) {
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
    assert.equal(await tab.value(`(() => { const { top, bottom } = document.querySelector("#section").getBoundingClientRect(); return bottom > 0 && top < innerHeight; })()`), true);
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

for (const page of pages.odd ?? []) {
    test(`${page.name} is shown`, options, async () => {
        const tab = await open(page);
        assert.equal(await tab.value(`document.querySelector(".response").dataset.branches`), String(page.branches));
        for (const option of await tab.value(`[...document.querySelectorAll("#section option")].map((one) => one.value)`)) {
            await tab.value(`(() => { const one = document.querySelector("#section select"); one.value = "${option}"; one.dispatchEvent(new Event("change")); })()`);
        }
        for (const sentence of page.says) {
            assert.ok((await tab.value(`document.body.innerText`)).includes(sentence), sentence);
        }
        await tab.press("ArrowRight");
        const sentence = await tab.value(`document.querySelector(".which").textContent`);
        assert.ok(sentence.includes(page.orbit), sentence);
        await drawn(tab);
        if (pictures !== "") {
            writeFileSync(join(pictures, `page-${page.name.replaceAll(" ", "-")}.png`), await tab.picture());
        }
        assert.deepEqual(tab.complaints, []);
    });
}
