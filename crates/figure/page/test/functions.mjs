// The sources of the page without a browser.

import { join } from "node:path";

import { build } from "esbuild";

/** The functions of a file of src/. */
export async function functionsOf(file) {
    const options = { absWorkingDir: join(import.meta.dirname, ".."), bundle: true, format: "esm", write: false };
    const { outputFiles } = await build({ ...options, entryPoints: [`src/${file}`] });
    return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}
