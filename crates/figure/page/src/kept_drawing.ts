// What was drawn, kept while one pans: lines and marks of a part of the diagram larger than what is seen,
// which are shifted instead of made anew.

import type { Scales } from "./curves";
import { linesOf, type Lines } from "./paths";
import { placeMarks, type PlacedMark } from "./place_marks";
import type { Scene } from "./response_paint";

/** How much is made beyond each edge, as a share of width and height. */
const BEYOND = 0.5;

/** Where a view stands on what is kept, in canvas pixels. */
type Shift = readonly [across: number, down: number];

export class KeptDrawing {
    private scales: Scales | null = null;
    private density = 0;
    private columns: readonly [Float64Array, Float64Array] | null = null;
    private lines: (Lines | undefined)[] = [];
    private marks: readonly PlacedMark[] | null = null;
    private marked: unknown[] = [];

    /** Makes room for a view; says by how much what is kept is shifted in it. */
    shiftTo(scene: Scene, scales: Scales, density: number): Shift {
        const columns = [scene.curves.across(scene.state), scene.curves.levels(scene.state)] as const;
        const kept = this.scales;
        if (
            kept !== null &&
            this.density === density &&
            columns.every((column, k) => column === this.columns?.[k]) &&
            isSameScale(kept, scales)
        ) {
            const shift: Shift = [
                (kept.lowX - scales.lowX) * scales.perX,
                (scales.lowY - kept.lowY) * scales.perY,
            ];
            if (Math.abs(shift[0]) <= BEYOND * scales.width && Math.abs(shift[1]) <= BEYOND * scales.height) {
                return shift;
            }
        }
        [this.scales, this.density, this.columns, this.lines, this.marks] = [
            scales,
            density,
            columns,
            [],
            null,
        ];
        return [0, 0];
    }

    /** Lines of a branch, unshifted. */
    linesOf({ meta, solutions, theme }: Scene, place: number): Lines | null {
        const branch = meta.branches[place];
        if (this.scales === null || this.columns === null || branch === undefined) {
            return null;
        }
        const strokes = {
            count: theme.strokes(branch.period),
            spacing: 48 * this.density,
            apart: 3 * this.density,
            reach: 5 * this.density,
        };
        const [across, levels] = this.columns;
        const margin = [BEYOND * this.scales.width + 20, BEYOND * this.scales.height + 20] as const;
        return (this.lines[place] ??= linesOf(
            solutions,
            { across, levels, first: branch.first, count: branch.count },
            this.scales,
            strokes,
            margin,
        ));
    }

    /** Marks, unshifted. */
    marksOf({ meta, solutions, state, marked }: Scene): readonly PlacedMark[] {
        const wanted = [state.hidden, state.off, marked];
        if (this.scales === null || this.columns === null) {
            return [];
        }
        if (this.marks === null || wanted.some((part, k) => part !== this.marked[k])) {
            const [across, levels] = this.columns;
            const { left, top, width, height, perX, perY, lowX, lowY } = this.scales;
            const isDrawn = meta.branches.map((_, place) => !state.hidden.has(place));
            const [beside, above] = [BEYOND * width + 12 * this.density, BEYOND * height + 12 * this.density];
            this.marks = placeMarks(
                marked,
                state,
                (k) => {
                    const x = left + ((across[k] ?? NaN) - lowX) * perX;
                    const y = top + height - ((levels[k] ?? NaN) - lowY) * perY;
                    const isNear =
                        x >= left - beside &&
                        x <= left + width + beside &&
                        y >= top - above &&
                        y <= top + height + above;
                    return isNear && isDrawn[solutions.branch[k] ?? 0] === true ? [x, y] : null;
                },
                this.density,
            );
            this.marked = wanted;
        }
        return this.marks;
    }
}

function isSameScale(one: Scales, other: Scales): boolean {
    const same = (a: number, b: number): boolean => Math.abs(a - b) <= 1e-9 * Math.abs(b);
    return (
        same(one.perX, other.perX) &&
        same(one.perY, other.perY) &&
        one.log === other.log &&
        one.left === other.left &&
        one.top === other.top &&
        one.width === other.width &&
        one.height === other.height
    );
}
