// Masses in motion, without a browser: where they and their names are, and what joins them.

import assert from "node:assert/strict";
import { test } from "node:test";

import { functionsOf } from "./functions.mjs";

const { joinedOf, layoutOf, namesOf } = await functionsOf("mass_layout.ts");

test("masses stay apart and leave room for what joins them, however many there are", () => {
    for (const width of [260, 460, 900]) {
        for (const count of [1, 2, 9, 12, 25, 60]) {
            const { rest, spacing, size, room } = layoutOf(count, width);
            assert.equal(rest.length, count);
            assert.ok(rest[0] > 0 && rest.at(-1) < width);
            assert.ok(size > 0 && spacing - size >= 0.5 * spacing, "half of the length is springs");
            assert.ok(2 * room < spacing - size, "masses that move towards each other do not meet");
        }
    }
});

test("names do not overlap, those that are cut keep their beginning and their end", () => {
    const widthOf = (text) => 7 * text.length;
    const names = Array.from({ length: 25 }, (_, k) => `mass number ${k}`);
    for (const [count, spacing] of [[2, 90], [9, 40], [12, 31], [25, 15]]) {
        const own = names.slice(0, count);
        const shown = namesOf(own, spacing, widthOf);
        const named = shown.flatMap((name, k) => (name === "" ? [] : [[name, k]]));
        assert.ok(named.length >= 2, `${named}`);
        named.forEach(([name, k], place) => {
            const [next, other] = named[place + 1] ?? ["", Infinity];
            assert.ok(widthOf(name) / 2 + widthOf(next) / 2 < (other - k) * spacing, `${name} and ${next} overlap`);
            const [head, tail = ""] = name.split("…");
            assert.ok(own[k].startsWith(head) && own[k].endsWith(tail));
        });
    }
    assert.deepEqual(namesOf(["a", "b", "c"], 20, widthOf), ["a", "b", "c"]);
});

test("links that would cover each other have levels of their own", () => {
    const link = (a, b, damper = false) => ({ ends: [a, b], damper });
    const joined = joinedOf([link(0, null), link(0, null, true), link(2, 1), link(1, null), link(3, null), link(0, 2), link(1, 3), link(2, 0, true)], 4);
    const kinds = joined.map(({ kind, from, to, level, levels }) => [kind, from, to, level, levels]);
    assert.deepEqual(kinds, [
        ["direct", -1, 0, 0, 2],
        ["direct", -1, 0, 1, 2],
        ["direct", 1, 2, 0, 1],
        ["held", -1, 1, 0, 1],
        ["direct", 3, 4, 0, 1],
        ["far", 0, 2, 0, 3],
        ["far", 1, 3, 2, 3],
        ["far", 0, 2, 1, 3],
    ]);
});
