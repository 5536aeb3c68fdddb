// Labels of axes, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";

import { functionsOf } from "./functions.mjs";

const { commonPart, ticks } = await functionsOf("format.ts");
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

test("labels stay short however near their ticks are, and say with what they leave out where those are", () => {
    for (const [low, width] of [[39.692213781, 2e-8], [39.69, 1e-5], [3.694525686, 3e-9], [123456.7, 1e-4], [-112.178251, 3e-7], [599990, 1e-3], [0.99999999, 4e-8]]) {
        const distance = 10 ** Math.floor(Math.log10(width / 4));
        const first = Math.ceil(low / distance);
        const splits = Array.from({ length: 5 }, (_, k) => (first + k) * distance);
        const common = commonPart(low, low + width, distance);
        assert.notEqual(common, 0);
        const labels = ticks(splits, distance, common);
        labels.forEach((label, k) => {
            assert.ok(label.length <= 9, `${label} of ${splits[k]}`);
            assert.ok(Math.abs(common + valueOf(label) - splits[k]) < 1e-3 * distance, `${common} + ${label} at ${splits[k]}`);
        });
        assert.ok(`${common}`.length <= 13, `${common}`);
    }
    assert.equal(commonPart(19, 110, 10), 0);
    assert.equal(commonPart(39.6, 39.7, 0.01), 0);
    assert.equal(commonPart(3e5, 6e5, 5e4), 0);
    assert.equal(commonPart(-1, 1, 0.5), 0);
});

test("all labels of a logarithmic axis have one form", () => {
    const labelled = (low, high) => logAxis(low, high, 12).labels.filter((label) => label !== "");
    assert.deepEqual(labelled(2e-4, 0.03), ["2e−4", "5e−4", "1e−3", "2e−3", "5e−3", "1e−2", "2e−2"]);
    assert.deepEqual(labelled(0.001, 0.5), ["0.001", "0.01", "0.1"].flatMap((one) => [1, 2, 5].map((part) => String(Number((part * one).toPrecision(1))))));
    for (const [low, high] of [[2e-4, 0.03], [1e-8, 1e4], [30, 3e6], [0.02, 9e4]]) {
        const forms = new Set(labelled(low, high).map((label) => label.includes("e")));
        assert.equal(forms.size, 1, `${labelled(low, high)}`);
    }
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
    // Room for a label at every tick is no reason to have one there.
    assert.deepEqual(logAxis(0.9, 21, 20).labels.filter((label) => label !== ""), ["1", "2", "5", "10", "20"]);
});
