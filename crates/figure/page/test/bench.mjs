// How long the page takes to open, to pan and to redraw a zoom, in headless Chromium: node test/bench.mjs PAGE [--judge]
//
// Opening: from the call for the page to the first picture with the diagram in it. Panning: the diagram drawn at 60 places, of all of it and of a tenth of it. A zoom: drawn at 60
// views from all of it down to a thousandth of it. Each time until its pixels can be read. With --judge it fails where the page has 20 MB, opens in 2 s or pans in 50 ms, or takes
// more (medians).

import { statSync } from "node:fs";
import { pathToFileURL } from "node:url";

import { launch } from "./browser.mjs";

const [page, judge] = process.argv.slice(2);
if (page === undefined) {
    console.error("usage: node test/bench.mjs PAGE [--judge]");
    process.exit(2);
}
const ROUNDS = 5;
const browser = await launch();
const times = { opening: [], "panning all": [], "panning a tenth": [], "redraw of a zoom": [] };
/** Milliseconds that a change and the drawing after it take, 60 times. */
const timed = (change) => `(() => {
    const canvas = document.querySelector(".response canvas");
    return Array.from({ length: 60 }, (_, k) => {
        const begun = performance.now();
        ${change};
        hammerbeam.redraw();
        canvas.getContext("2d").getImageData(10, 10, 1, 1);
        return performance.now() - begun;
    });
})()`;
for (let round = 0; round < ROUNDS; round++) {
    const tab = await browser.tab();
    const begun = performance.now();
    await tab.open(pathToFileURL(page).href);
    await tab.until(`window.hammerbeam !== undefined`);
    await tab.value(`new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))`);
    times.opening.push(performance.now() - begun);
    await tab.value(`new Promise((done) => setTimeout(done, 1000))`);
    times["panning all"].push(...(await tab.value(timed("hammerbeam.pan(k % 2 ? 0.02 : -0.02, 0)"))));
    await tab.value(`hammerbeam.zoom(0.1)`);
    times["panning a tenth"].push(...(await tab.value(timed("hammerbeam.pan(k < 30 ? 0.05 : -0.05, 0)"))));
    await tab.value(`hammerbeam.zoom(10)`);
    times["redraw of a zoom"].push(...(await tab.value(timed("hammerbeam.zoom(0.89)"))));
    await browser.closeTabs();
}
await browser.close();
const middle = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];
const megabytes = statSync(page).size / 1e6;
console.log(`size: ${megabytes.toFixed(1)} MB`);
for (const [name, values] of Object.entries(times)) {
    console.log(`${name}: median ${middle(values).toFixed(1)} ms, least ${Math.min(...values).toFixed(1)} ms, most ${Math.max(...values).toFixed(1)} ms of ${values.length}`);
}
if (judge === "--judge" && (megabytes >= 20 || middle(times.opening) >= 2000 || middle(times["panning all"]) >= 50 || middle(times["panning a tenth"]) >= 50)) {
    console.error("too large or too slow: 20 MB, 2 s to open, 50 ms to pan");
    process.exit(1);
}
