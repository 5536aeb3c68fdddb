// What is meant by a place of the diagram: a solution, a point over the branches, a chaotic range.

import { isOverFrequency, rangeAt, STRIP } from "./chaos";
import { scalesOf, type Curves } from "./curves";
import type { Meta } from "./data";
import type { Frame } from "./frame";
import { dotsOf, type Dot } from "./overlay";
import type { State } from "./state";
import { MEASURES } from "./units";

/** Distance (CSS pixels) from which a solution or a point is meant by the pointer. */
const REACH = 24;

/** `beside`: the solution that is meant where the point cannot be; -1 for none. */
export type Picked =
    { solution: number } | { dot: Dot; beside: number } | { range: [number, number]; frequency: number };

/** What lies nearest to a place in CSS pixels of the frame; null for nothing. */
export function pick(
    meta: Meta,
    curves: Curves,
    state: State,
    frame: Frame,
    left: number,
    top: number,
): Picked | null {
    const { bbox } = frame.plot;
    const density = frame.density;
    const scales = scalesOf(frame.range(), bbox);
    const [x, y] = [bbox.left + left * density, bbox.top + top * density];
    const { factor } = MEASURES.frequency;
    const frequency = ((x - scales.left) / scales.perX + scales.lowX) / factor;
    const range =
        state.off.has("chaos") || !isOverFrequency(state)
            ? null
            : rangeAt(meta, frequency, (3 * density) / scales.perX / factor);
    if (range !== null && top < STRIP) {
        return { range, frequency };
    }
    const [solution, within] = curves.nearest(state, scales, [x, y], REACH * density);
    let [nearest, least] = [null as Dot | null, within];
    for (const dot of dotsOf(meta, state)) {
        const away = Math.hypot(frame.toX(dot.x) - x, frame.toY(dot.value) - y);
        if (away < least) {
            [nearest, least] = [dot, away];
        }
    }
    if (nearest !== null) {
        return { dot: nearest, beside: solution };
    }
    return solution >= 0 ? { solution } : range !== null ? { range, frequency } : null;
}
