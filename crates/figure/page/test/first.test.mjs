// The solution that is selected when the page opens, without a browser.

import assert from "node:assert/strict";
import { test } from "node:test";

import { functionsOf } from "./functions.mjs";

const { firstSolution } = await functionsOf("first.ts");
const [STABLE, MARGINAL] = [1, 64];

/** What is selected of branches, each a list of displacements with flags, where these orbits are carried. */
function selected(branches, orbits) {
    const all = branches.flat();
    const meta = { branches: [], orbits: { solutions: orbits } };
    for (const branch of branches) {
        const last = meta.branches.at(-1) ?? { first: 0, count: 0 };
        meta.branches.push({ over: 0, first: last.first + last.count, count: branch.length });
    }
    const solutions = {
        branch: branches.flatMap((branch, number) => branch.map(() => number)),
        flags: all.map(([, flags]) => flags),
        maxima: { displacement: all.map(([displacement]) => displacement) },
    };
    return firstSolution(meta, solutions);
}

test("the largest stable solution is selected, not a larger one that is marginal or unstable", () => {
    const branch = [[1, STABLE], [2, STABLE], [3, STABLE | MARGINAL], [4, 0], [5, MARGINAL]];
    assert.equal(selected([branch], [0, 1, 2, 3, 4]), 1);
    // The orbit of the bifurcation is the nearest one that is carried, but it is not stable.
    assert.equal(selected([branch], [0, 2]), 0);
    assert.equal(selected([branch], [2, 3]), 1, "no stable orbit is carried");
});

test("a branch with a stable solution comes before one that has marginal ones only", () => {
    assert.equal(selected([[[9, STABLE | MARGINAL]], [[1, STABLE], [2, STABLE]]], [0, 1, 2]), 2);
});

test("where no solution is stable the largest one is selected", () => {
    assert.equal(selected([[[1, 0], [3, STABLE | MARGINAL], [2, 0]]], [1]), 1);
    assert.equal(selected([[[1, 0], [2, 0]]], []), 1);
    assert.equal(selected([], []), -1);
});
