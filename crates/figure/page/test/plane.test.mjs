// The frame of the multipliers, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";

import { functionsOf } from "./functions.mjs";

const { edgesOf, isWithin } = await functionsOf("plane.ts");

test("the unit circle is whole and one, and multipliers that are not far off are in the frame, whatever its shape", () => {
    for (const [width, height] of [[140, 242], [176, 242], [242, 242], [400, 242], [30, 242]]) {
        for (const largest of [0.3, 0.97, 1.253, 2, 3.4]) {
            const multipliers = [[-largest, 0], [0, largest], [0, -largest], [0.1, 0.2], [0.1, -0.2]];
            const edges = edgesOf(multipliers, width, height);
            assert.ok(Math.abs(edges[0] / edges[1] / (width / height) - 1) < 1e-12, "a circle is one");
            assert.ok(Math.min(...edges) >= 1.2, `the unit circle is cut at ${edges}`);
            assert.ok(multipliers.every((one) => isWithin(one, edges)), `${largest} is outside of ${edges}`);
        }
    }
});

test("where one is far away the others are still seen, and it is outside", () => {
    const far = [[-1e6, 0], [Infinity, 0], [NaN, 0], [2, 30]];
    const edges = edgesOf([...far, [-1.253, 0]], 176, 242);
    assert.deepEqual(far.map((one) => isWithin(one, edges)), [false, false, false, false]);
    assert.ok(isWithin([-1.253, 0], edges));
});
