// What the response diagram shows: the solution at the start, marks, axes, and what is saved of it.

import assert from "node:assert/strict";
import { test } from "node:test";

import { drawn, meta, open, options, orbitIsOpen, pages, rich } from "./shared.mjs";

const labels = (tab) => tab.value(`hammerbeam.labels()`);
const marks = (tab) => tab.value(`hammerbeam.marks()`);
/** Chooses in the list with that label. */
const choose = (tab, label, value) => tab.value(`(() => { const one = [...document.querySelectorAll(".choice")].find((two) => two.firstChild.textContent === "${label}").querySelector("select"); one.value = "${value}"; one.dispatchEvent(new Event("change")); })()`);

test("a stable solution with its orbit is selected at the start, and none where the reader wants none", options, async () => {
    const tab = await open(pages.run);
    await tab.until(orbitIsOpen);
    const { selected, hidden } = await tab.value(`hammerbeam.state()`);
    assert.ok(selected >= 0 && hidden !== undefined);
    assert.ok((await tab.value(`document.querySelector("#selected").innerText`)).includes("stable"));
    assert.ok((await tab.value(`document.querySelector("#multipliers .note").textContent`)).length > 0);
    await tab.press("Escape");
    await tab.until(`location.hash.includes("at=none")`);
    const again = await open(pages.run, await tab.value(`location.hash`));
    assert.equal(await again.value(`hammerbeam.state().selected`), -1);
    assert.deepEqual([...tab.complaints, ...again.complaints], []);
});

test("the page has the words of printed figures", options, async () => {
    const tab = await open(pages.run);
    const { branches } = await tab.value(meta);
    const words = await tab.value(`document.body.innerText`);
    assert.ok(words.includes("harmonic") && !/period [2-9]/.test(words), "no period 2");
    for (const period of new Set(branches.map((branch) => branch.period).filter((period) => period > 1))) {
        assert.ok(words.includes(`1/${period} subharmonic`));
    }
    assert.ok((await labels(tab)).titles[1].startsWith("Displacement max |y|"));
});

test("axes show outputs, upright, across and in a link", options, async () => {
    const tab = await open(pages.run);
    await choose(tab, "Show", "output-1");
    await drawn(tab);
    assert.match((await labels(tab)).titles[1], /^push, maximum force \(k?N\)$/);
    await choose(tab, "Over", "output-2");
    await drawn(tab);
    assert.match((await labels(tab)).titles[0], /^push, mean force \(k?N\)$/);
    // The address follows a moment later.
    await tab.until(`location.hash.includes("show=output-1") && location.hash.includes("over=output-2")`);
    const hash = await tab.value(`location.hash`);
    const again = await open(pages.run, hash);
    assert.deepEqual((await labels(again)).titles, (await labels(tab)).titles);
    assert.deepEqual([...tab.complaints, ...again.complaints], []);
});

test("marks keep their distance, those of stable solutions before all others, and more of them appear in a zoom", options, async () => {
    const tab = await open(pages.run);
    const apart = (found) => {
        for (const [k, one] of found.entries()) {
            for (const other of found.slice(0, k)) {
                const away = Math.hypot(one.at[0] - other.at[0], one.at[1] - other.at[1]);
                assert.ok(away >= one.room + other.room - 1e-9, `${one.layer} at ${one.solution} is ${away} from ${other.layer} at ${other.solution}`);
            }
        }
    };
    const whole = await marks(tab);
    assert.ok(whole.length > 5, `${whole.length} marks`);
    apart(whole);
    const target = whole.find(({ layer }) => layer !== "grazing").solution;
    await tab.value(`(() => { const row = [...document.querySelectorAll("#bifurcations tbody tr")].find((one) => one.dataset.solution === "${target}"); row.querySelector("button").click(); })()`);
    await drawn(tab);
    const near = await marks(tab);
    apart(near);
    assert.ok(near.some(({ solution }) => solution === target), "the bifurcation that was zoomed to has its mark");
    // A kind that is switched off leaves its room to others.
    const [layer] = near.map((one) => one.layer);
    await tab.value(`document.querySelector('[data-layer="${layer}"]').click()`);
    await drawn(tab);
    assert.ok((await marks(tab)).every((one) => one.layer !== layer));
    assert.deepEqual(tab.complaints, []);
});

test("both axes show what is chosen, and a link keeps it", options, async () => {
    const tab = await open(pages.run);
    for (const [quantity, title] of [["acceleration", "Acceleration"], ["multiplier", "Largest multiplier"], ["energy", "Energy of the structure"], ["contacts", "Contacts per orbit period"]]) {
        await choose(tab, "Show", quantity);
        await drawn(tab);
        assert.ok((await labels(tab)).titles[1].startsWith(title), `${(await labels(tab)).titles}`);
    }
    await choose(tab, "Show", "displacement");
    await choose(tab, "Over", "energy");
    await drawn(tab);
    assert.ok((await labels(tab)).titles[0].startsWith("Energy"));
    // A solution is where its energy and its displacement are.
    const { selected } = await tab.value(`hammerbeam.state()`);
    const [x, y] = await tab.value(`hammerbeam.placeOf(${selected})`);
    const box = await tab.value(`(() => { const { left, right, top, bottom } = document.querySelector(".response .u-over").getBoundingClientRect(); return { left, right, top, bottom }; })()`);
    assert.ok(x >= box.left && x <= box.right && y >= box.top && y <= box.bottom);
    await tab.until(`location.hash.includes("over=energy")`);
    const again = await open(pages.run, await tab.value(`location.hash`));
    assert.equal(await again.value(`hammerbeam.state().across`), "energy");
    assert.deepEqual([...tab.complaints, ...again.complaints], []);
});

test("branches over another parameter are shown over it, and the others over the frequency", options, async () => {
    const tab = await open(rich);
    const { parameters, branches } = await tab.value(meta);
    assert.equal(parameters.length, 1);
    const seen = () => tab.value(`document.querySelector(".response").dataset.branches`);
    const own = branches.filter(({ over }) => over === 0 && true).length;
    assert.equal(await seen(), String(own));
    await choose(tab, "Branches over", "1");
    await drawn(tab);
    assert.equal(await seen(), String(branches.length - own));
    // Gaps to 40 nm, which are metres in the data.
    const { titles, x } = await labels(tab);
    assert.ok(titles[0].startsWith("Gap of stop 1 (nm)"), titles[0]);
    assert.ok(x.includes("20") && !x.includes("2e-8"), `${x}`);
    assert.ok((await tab.value(`document.querySelector("#branches tbody").innerText`)).includes("8"));
    await tab.until(`location.hash.includes("parameter=1")`);
    const again = await open(rich, await tab.value(`location.hash`));
    assert.equal(await again.value(`document.querySelector(".response").dataset.branches`), String(branches.length - own));
    assert.deepEqual([...tab.complaints, ...again.complaints], []);
});

test("a logarithmic axis has labels and lines at few ticks, and short strokes at the others", options, async () => {
    const tab = await open(rich);
    await choose(tab, "Scale", "log");
    await drawn(tab);
    const { y, minor } = await labels(tab);
    assert.ok(y.length >= 2 && y.length <= 12 && minor > y.length, `${y} and ${minor} minor ticks`);
});

test("what is seen is saved as SVG, PNG and CSV", options, async () => {
    const tab = await open(pages.run);
    const svg = await tab.value(`hammerbeam.saved("svg")`);
    const parsed = await tab.value(`(() => { const made = new DOMParser().parseFromString(${JSON.stringify(svg)}, "image/svg+xml"); return { errors: made.querySelectorAll("parsererror").length, paths: made.querySelectorAll("path").length, letters: made.documentElement.getAttribute("text-rendering"), texts: [...made.querySelectorAll("text")].map((one) => one.textContent) }; })()`);
    assert.equal(parsed.errors, 0);
    assert.ok(parsed.paths >= pages.run.branches);
    assert.equal(parsed.letters, "geometricPrecision", "letters stand where they were measured");
    for (const text of ["Excitation frequency (Hz)", "harmonic", "stable"]) {
        assert.ok(parsed.texts.includes(text), `${text} in ${parsed.texts}`);
    }
    assert.match(await tab.value(`hammerbeam.saved("png")`), /^image\/png \d{5,}$/);
    const csv = await tab.value(`hammerbeam.saved("csv")`);
    const rows = csv.trim().split("\n");
    const { branches } = await tab.value(meta);
    assert.ok(rows[0].startsWith("branch,period_multiple,frequency_hz,max_abs_displacement_m"));
    assert.equal(rows.length - 1, branches.reduce((sum, { count }) => sum + count, 0), "all of it is seen");
    await tab.value(`hammerbeam.zoom(0.2)`);
    assert.ok((await tab.value(`hammerbeam.saved("csv")`)).split("\n").length < 0.6 * rows.length, "fewer in a zoom");
    assert.deepEqual(tab.complaints, []);
});
