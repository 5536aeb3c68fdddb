// How long the page takes to open and to redraw a zoom, in headless Chromium: node test/bench.mjs PAGE
//
// Opening: from the call for the page to the first picture with the diagram in it. A zoom: the diagram drawn at 60 views from all of it down to a thousandth of it, every time
// until its pixels can be read.

import { pathToFileURL } from "node:url";

import { launch } from "./browser.mjs";

const page = process.argv[2];
if (page === undefined) {
    console.error("usage: node test/bench.mjs PAGE");
    process.exit(2);
}
const browser = await launch();
const opened = [];
let redraws = [];
for (let round = 0; round < 5; round++) {
    const tab = await browser.tab();
    const begun = performance.now();
    await tab.open(pathToFileURL(page).href);
    await tab.value(`new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))`);
    opened.push(performance.now() - begun);
    redraws = redraws.concat(
        await tab.value(`(() => {
            const canvas = document.querySelector(".response canvas");
            const times = [];
            for (let k = 0; k < 60; k++) {
                const begun = performance.now();
                hammerbeam.zoom(0.89);
                hammerbeam.redraw();
                canvas.getContext("2d").getImageData(10, 10, 1, 1);
                times.push(performance.now() - begun);
            }
            return times;
        })()`),
    );
}
await browser.close();
const middle = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];
const report = (name, values) =>
    console.log(`${name}: median ${middle(values).toFixed(1)} ms, least ${Math.min(...values).toFixed(1)} ms, most ${Math.max(...values).toFixed(1)} ms of ${values.length}`);
report("opening", opened);
report("redraw of a zoom", redraws);
