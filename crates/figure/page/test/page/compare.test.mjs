// Other results over the branches.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { drawn, open, options, pages, rich } from "./shared.mjs";

/** Opens a file as if the reader had chosen it. */
const compare = (tab, name, text) => tab.value(`hammerbeam.compare(${JSON.stringify(name)}, ${JSON.stringify(text)})`);
const entries = (tab) => tab.value(`[...document.querySelectorAll('.legend [data-layer^="compared"]')].map((one) => [one.textContent, one.getAttribute("aria-pressed")])`);

test("another page and a table of branches are drawn behind the branches, each with a switch", options, async () => {
    const tab = await open(rich);
    const pixels = () => tab.value(`(() => { const c = document.querySelector(".response canvas"); return c.toDataURL().length; })()`);
    const before = await pixels();
    const csv = "branch,period_multiple,frequency_hz,max_abs_displacement_m,stable,event\n1,1,12,0.004,true,start\n1,1,18,0.012,true,\n1,1,25,0.002,false,fold\n";
    await compare(tab, "branches.csv", csv);
    await compare(tab, "page.html", readFileSync(pages.run.path, "utf8"));
    await drawn(tab);
    const shown = await entries(tab);
    assert.equal(shown.length, 2);
    assert.ok(shown[0][0].includes("branches.csv") && shown[1][0].includes("page.html"), `${shown}`);
    assert.notEqual(await pixels(), before);
    await tab.value(`document.querySelectorAll('.legend [data-layer^="compared"]').forEach((one) => one.click())`);
    await tab.value(`document.querySelector('.legend [data-layer="compared:1"]').getAttribute("aria-pressed") === "true" && document.querySelector('.legend [data-layer="compared:1"]').click()`);
    await drawn(tab);
    assert.deepEqual((await entries(tab)).map(([, pressed]) => pressed), ["false", "false"]);
    assert.deepEqual(tab.complaints, []);
});

test("what is saved as a table can be compared with, and what is no results is refused with the reason", options, async () => {
    const tab = await open(pages.run);
    await compare(tab, "saved.csv", await tab.value(`hammerbeam.saved("csv")`));
    assert.equal((await entries(tab)).length, 1);
    for (const [name, text] of [["notes.csv", "a,b\n1,2\n"], ["other.html", "<html></html>"]]) {
        await compare(tab, name, text);
        const said = await tab.value(`document.querySelector(".said").textContent`);
        assert.ok(said.includes(name) && /no column|no page/.test(said), said);
    }
    assert.equal((await entries(tab)).length, 1);
    assert.deepEqual(tab.complaints, []);
});
