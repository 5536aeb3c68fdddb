// Labels of axes, without a browser.

import assert from "node:assert/strict";
import { join } from "node:path";
import { test } from "node:test";

import { build } from "esbuild";

/** The functions of a file of src/. */
async function functionsOf(file) {
    const options = { absWorkingDir: join(import.meta.dirname, ".."), bundle: true, format: "esm", write: false };
    const { outputFiles } = await build({ ...options, entryPoints: [`src/${file}`] });
    return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}

const { ticks } = await functionsOf("format.ts");
const { logAxis } = await functionsOf("log_axis.ts");
const valueOf = (label) => Number(label.replaceAll("−", "-"));

test("labels say where the ticks are, from the smallest to the largest distances", () => {
    for (let exponent = -15; exponent <= 9; exponent++) {
        for (const step of [1, 2, 2.5, 5]) {
            for (const begin of [-3, 0, 1, 40]) {
                const distance = step * 10 ** exponent;
                const splits = [0, 1, 2, 3, 4].map((k) => (begin + k) * distance);
                const labels = ticks(splits, distance);
                assert.equal(new Set(labels).size, labels.length, `${labels}`);
                labels.forEach((label, k) => assert.ok(Math.abs(valueOf(label) - splits[k]) < 1e-6 * distance, `${label} at ${splits[k]}`));
            }
        }
    }
    assert.deepEqual(ticks([0, 0.5, 1, null], 0.5), ["0", "0.5", "1.0", ""]);
    assert.deepEqual(ticks([-112.17825, -112.17824], 1e-5), ["−112.17825", "−112.17824"]);
});

test("ticks of a logarithmic axis stand at round numbers, wherever it begins", () => {
    for (const [low, high] of [[0.0373, 21.7], [0.9e-9, 3e4], [1.234, 1.31], [3.3, 8.8], [2.2e-7, 2.3e-7], [5, 5.0001]]) {
        const { splits, labels } = logAxis(low, high, 8);
        assert.equal(splits.length, labels.length);
        const labelled = labels.filter((label) => label !== "");
        assert.ok(labelled.length >= 2 && labelled.length <= 18, `${low} to ${high}: ${labels}`);
        splits.forEach((value, k) => {
            assert.ok(value >= low && value <= high);
            if (labels[k] !== "") {
                assert.ok(Math.abs(valueOf(labels[k]) / value - 1) < 1e-9, `${labels[k]} at ${value}`);
            }
        });
    }
    const { splits, labels } = logAxis(0.037, 21.7, 6);
    assert.deepEqual(splits.slice(0, 7), [0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1]);
    assert.deepEqual(labels.filter((label) => label !== ""), ["0.1", "1", "10"]);
});
