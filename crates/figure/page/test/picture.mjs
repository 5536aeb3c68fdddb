// A picture of a page as a browser shows it: node test/picture.mjs PAGE PNG [#STATE]

import { writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

import { launch } from "./browser.mjs";

const [page, picture, state = ""] = process.argv.slice(2);
if (picture === undefined) {
    console.error("usage: node test/picture.mjs PAGE PNG [#STATE]");
    process.exit(2);
}
const browser = await launch();
const tab = await browser.tab(1400, 1560, [{ name: "prefers-color-scheme", value: "light" }, { name: "prefers-reduced-motion", value: "reduce" }]);
await tab.open(pathToFileURL(page).href + state);
await tab.until(`window.hammerbeam !== undefined`);
await tab.value(`new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))`);
writeFileSync(picture, await tab.picture());
await browser.close();
