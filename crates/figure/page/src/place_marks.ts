// Where marks are drawn: none covers another one. Those that say most take their places first; the others
// appear when there is room, as one zooms in.

import { MARKS, type Mark, type Marked } from "./marks";
import type { State } from "./state";

/** A mark at a place (canvas pixels), of a solution. */
export interface PlacedMark {
    mark: Mark;
    solution: number;
    at: [number, number];
}

/**
 * Least distance of two marks at most (CSS pixels): the size of the cells in which neighbours are looked
 * for.
 */
const CELL = 2 * MARKS.reduce((most, { room }) => Math.max(most, room), 0);

/**
 * The marks that are drawn.
 *
 * * `marked`: in the order in which they take their places.
 * * `place`: of a solution; null where it is not seen or its branch is not drawn.
 */
export function placeMarks(
    marked: readonly Marked[],
    { off }: Pick<State, "off">,
    place: (solution: number) => [number, number] | null,
    density: number,
): PlacedMark[] {
    const taken = new Map<number, PlacedMark[]>();
    const placed: PlacedMark[] = [];
    const cell = CELL * density;
    const key = (column: number, row: number): number => column * 65536 + row;
    for (const { solution, kinds } of marked) {
        const layer = kinds.find((kind) => !off.has(kind));
        const mark = layer === undefined ? undefined : MARKS.find((one) => one.layer === layer);
        const at = mark === undefined ? null : place(solution);
        if (mark === undefined || at === null) {
            continue;
        }
        const [column, row] = [Math.floor(at[0] / cell), Math.floor(at[1] / cell)];
        const own = { mark, solution, at };
        if (!isCrowded(taken, own, [column, row], key, density)) {
            placed.push(own);
            const others = taken.get(key(column, row));
            others === undefined ? taken.set(key(column, row), [own]) : others.push(own);
        }
    }
    return placed;
}

/** Whether a mark is nearer to one that has its place than both have room. */
function isCrowded(
    taken: Map<number, PlacedMark[]>,
    { mark, at: [x, y] }: PlacedMark,
    [column, row]: [number, number],
    key: (column: number, row: number) => number,
    density: number,
): boolean {
    for (let across = column - 1; across <= column + 1; across++) {
        for (let down = row - 1; down <= row + 1; down++) {
            for (const other of taken.get(key(across, down)) ?? []) {
                const [right, below, apart] = [
                    x - other.at[0],
                    y - other.at[1],
                    (mark.room + other.mark.room) * density,
                ];
                if (right * right + below * below < apart * apart) {
                    return true;
                }
            }
        }
    }
    return false;
}
