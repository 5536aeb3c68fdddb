// Builds the script and the style of the page from src/ into dist/, which is stored beside the sources.
// With --compare nothing is written: it fails where dist/ is not what the sources give.

import { readFile, writeFile } from "node:fs/promises";
import { build } from "esbuild";

const compares = process.argv.includes("--compare");
const options = {
    absWorkingDir: import.meta.dirname,
    bundle: true,
    charset: "utf8",
    legalComments: "none",
    minify: true,
    target: "es2022",
    write: false,
};
const script = await build({ ...options, entryPoints: ["src/main.ts"], format: "iife" });
const look = await build({ ...options, entryPoints: ["src/page.css"] });
const licence = await readFile(new URL("node_modules/uplot/LICENSE", import.meta.url));

const files = {
    "page.js": script.outputFiles[0].contents,
    "page.css": look.outputFiles[0].contents,
    "LICENCE-uPlot.txt": licence,
};
const differing = [];
for (const [name, contents] of Object.entries(files)) {
    const path = new URL(`dist/${name}`, import.meta.url);
    if (!compares) {
        await writeFile(path, contents);
        console.log(`dist/${name}: ${contents.length} bytes`);
    } else if (!(await readFile(path)).equals(contents)) {
        differing.push(`dist/${name}`);
    }
}
if (differing.length > 0) {
    console.error(`${differing.join(", ")}: not what the sources give; run "npm run build" in crates/figure/page`);
    process.exit(1);
}
