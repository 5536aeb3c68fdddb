// What is drawn when the page opens, in windows and on paper of all kinds.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { coloured, DARK, drawn, meta, open, options, orbitIsOpen, pages, pictures, rich } from "./shared.mjs";

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
    // Before another tab is in front of it: a browser may draw nothing behind that.
    if (pictures !== "") {
        writeFileSync(join(pictures, "page-narrow.png"), await tab.picture());
    }
    const full = await open(rich, "", { width: 400, height: 800 });
    assert.equal(await full.value(`document.documentElement.scrollWidth <= innerWidth`), true);
});

test("nine periods are told apart without colours: by strokes across their lines", options, async () => {
    const page = pages.odd.find(({ name }) => name === "nine periods");
    const tab = await open(page);
    const { branches, look } = await tab.value(meta);
    // Columns with the colour of a branch four pixels above its line.
    const strokes = ({ first, period }) => tab.value(`(() => {
        const canvas = document.querySelector(".response canvas");
        const box = canvas.getBoundingClientRect();
        const density = canvas.width / box.width;
        const [[from, y], [to]] = [hammerbeam.placeOf(${first}), hammerbeam.placeOf(${first + 1})];
        const width = Math.floor((to - from) * density);
        const { data } = canvas.getContext("2d").getImageData((from - box.left) * density, Math.round((y - box.top - 4) * density), width, 1);
        const wanted = [1, 3, 5].map((at) => parseInt("${look.light.periods[period - 1]}".slice(at, at + 2), 16));
        const ink = Array.from({ length: width }, (_, k) => data[4 * k + 3] > 90 && wanted.every((value, channel) => Math.abs(value - data[4 * k + channel]) < 60));
        return ink.filter((is, k) => is && !ink[k - 1]).length;
    })()`);
    const found = [];
    for (const branch of branches) {
        found.push(await strokes(branch));
    }
    // A group every 48 pixels; where a stroke falls between two columns it may count twice or not at all.
    const groups = Math.floor((await tab.value(`hammerbeam.placeOf(1)[0] - hammerbeam.placeOf(0)[0]`)) / 48);
    found.forEach((count, place) => {
        const expected = Math.floor(place / 3) * groups;
        assert.ok(Math.abs(count - expected) <= 0.15 * expected, `${found} of ${groups} groups`);
    });
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
