// The solution that is selected when the page opens.

import { MARGINAL, STABLE, type Meta, type Solutions } from "./data";
import { nearestOrbit } from "./orbit";

/**
 * The stable solution of largest displacement on the first branch that has one, or the nearest stable one
 * whose orbit is carried. Where no solution is stable, the largest of the first branch, or the nearest one
 * with an orbit; -1 where there is no solution. Marginal solutions are not stable here.
 */
export function firstSolution(meta: Meta, solutions: Solutions): number {
    const over = meta.branches.filter((branch) => branch.over === 0 && branch.count > 0);
    const isStable = (k: number): boolean => ((solutions.flags[k] ?? 0) & (STABLE | MARGINAL)) === STABLE;
    const largest = (
        { first, count }: { first: number; count: number },
        suits: (k: number) => boolean,
    ): number => {
        let best = -1;
        for (let k = first; k < first + count; k++) {
            const value = solutions.maxima.displacement[k] ?? NaN;
            if (
                suits(k) &&
                (best < 0 ? Number.isFinite(value) : value > (solutions.maxima.displacement[best] ?? 0))
            ) {
                best = k;
            }
        }
        return best;
    };
    const stable = over.map((branch) => largest(branch, isStable)).find((k) => k >= 0);
    if (stable !== undefined) {
        const { branch } = solutions;
        const isNear = (k: number): boolean => isStable(k) && branch[k] === branch[stable];
        const distance = (k: number): number => Math.abs(k - stable);
        const nearer = (a: number, b: number): number => (distance(b) < distance(a) ? b : a);
        const carried = meta.orbits.solutions.filter(isNear);
        return carried.length > 0 ? carried.reduce(nearer) : stable;
    }
    const found =
        over.map((branch) => largest(branch, () => true)).find((k) => k >= 0) ??
        over[0]?.first ??
        meta.branches.find(({ count }) => count > 0)?.first ??
        -1;
    return meta.orbits.solutions[found < 0 ? -1 : nearestOrbit(meta, solutions, found)] ?? found;
}
