// What is printed, and printed figures.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { DARK, drawn, isSeen, meta, open, options, orbitIsOpen, pages, pictures } from "./shared.mjs";

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
