// The solution that is selected when the page opens.

import { STABLE, type Meta, type Solutions } from "./data";
import { nearestOrbit } from "./orbit";

/**
 * The stable solution of largest displacement on the first branch that has one, or one beside it whose
 * orbit is carried; -1 where there is no solution.
 */
export function firstSolution(meta: Meta, solutions: Solutions): number {
    const over = meta.branches.filter((branch) => branch.over === 0 && branch.count > 0);
    const largest = ({ first, count }: { first: number; count: number }, bits: number): number => {
        let best = -1;
        for (let k = first; k < first + count; k++) {
            const value = solutions.maxima.displacement[k] ?? NaN;
            if (
                ((solutions.flags[k] ?? 0) & bits) === bits &&
                (best < 0 ? Number.isFinite(value) : value > (solutions.maxima.displacement[best] ?? 0))
            ) {
                best = k;
            }
        }
        return best;
    };
    const found =
        over.map((branch) => largest(branch, STABLE)).find((k) => k >= 0) ??
        over.map((branch) => largest(branch, 0)).find((k) => k >= 0) ??
        over[0]?.first ??
        meta.branches.find(({ count }) => count > 0)?.first ??
        -1;
    return meta.orbits.solutions[found < 0 ? -1 : nearestOrbit(meta, solutions, found)] ?? found;
}
