// The page in a real headless Chromium: what all tests of it share.
//
// The pages come from the test that runs this file (crates/cli/tests/page.rs), as HAMMERBEAM_PAGES: a JSON document with, for each page, its path, the number of its branches,
// and what is odd about it. Pictures are kept in HAMMERBEAM_PICTURES.

import { mkdirSync } from "node:fs";
import { after, afterEach, before } from "node:test";
import { pathToFileURL } from "node:url";

import { launch } from "../browser.mjs";

export const pages = JSON.parse(process.env.HAMMERBEAM_PAGES ?? "{}");
export const pictures = process.env.HAMMERBEAM_PICTURES ?? "";
export const LIGHT = [{ name: "prefers-color-scheme", value: "light" }];
export const DARK = [{ name: "prefers-color-scheme", value: "dark" }];

let browser = null;
let reason = pages.run === undefined ? "HAMMERBEAM_PAGES names no page: cargo test -p hammerbeam-cli --test tests -- page runs this test" : "";
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
export const options = reason === "" ? {} : { skip: reason };
before(() => pictures !== "" && mkdirSync(pictures, { recursive: true }));
afterEach(() => browser?.closeTabs()); // what moves in them takes time
after(() => browser?.close());

/** The page with something of everything. */
export const rich = pages.odd?.find(({ name }) => name === "everything at once");

/** Whether the page is there, multipliers and all. */
export const isReady = `window.hammerbeam !== undefined && (document.querySelector(".solution.none") !== null || document.querySelector("#multipliers .note").textContent !== "")`;

/** Opens a page in a tab of its own. */
export async function open(page, hash = "", { width = 1400, height = 1000, features = LIGHT } = {}) {
    const tab = await browser.tab(width, height, features);
    await tab.open(pathToFileURL(page.path).href + hash);
    await tab.until(isReady);
    return tab;
}

/** Waits until everything that was asked for is drawn. */
export const drawn = (tab) => tab.value(`new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))))`);

export const orbitIsOpen = `document.querySelector(".solution").dataset.orbit !== ""`;
/** Whether an element is seen. */
export const isSeen = (selector) => `(() => { const one = document.querySelector(${JSON.stringify(selector)}); return one !== null && one.getClientRects().length > 0; })()`;
export const motion = `(() => { const c = document.querySelector("#motion canvas"); return c.width + ":" + c.toDataURL(); })()`;
export const meta = `JSON.parse(document.getElementById("meta").textContent)`;

/** Whether the diagram has a colour within some pixels of a solution. */
export const coloured = (solution, colour) => `(() => {
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
