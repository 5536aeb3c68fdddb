// What lies in the frame of the response diagram, from back to front.

import { scalesOf, type Curves, type Scales } from "./curves";
import { STRIP } from "./chaos";
import type { Meta, Solutions } from "./data";
import type { Frame } from "./frame";
import { apart, drawMarks, MARKS, standsFor, type Mark } from "./marks";
import { dotsOf } from "./overlay";
import { drawDots } from "./overlay_paint";
import { linesOf, type Strokes } from "./paths";
import { LAYERS, type State } from "./state";
import type { Theme } from "./theme";

export interface Scene {
    meta: Meta;
    solutions: Solutions;
    curves: Curves;
    state: State;
    theme: Theme;
    marked: Map<Mark, number[]>;
}

/** Dots of marginal lines and the gaps between (CSS pixels). */
export const DOTS: readonly number[] = [2, 3];

/** Draws everything; returns the number of branches of which something was drawn. */
export function paintResponse(context: CanvasRenderingContext2D, frame: Frame, scene: Scene): number {
    const scales = scalesOf(frame.range(), frame.plot.bbox);
    paintChaos(context, frame, scene);
    if (scene.state.marks) {
        paintMarks(context, frame, scene, scales, true);
    }
    const drawn = paintBranches(context, frame, scene, scales);
    if (scene.state.marks) {
        paintMarks(context, frame, scene, scales, false);
    }
    paintOverlay(context, frame, scene);
    paintSelected(context, frame, scene, scales);
    return drawn;
}

/** Chaotic ranges with a strip above them, and the frequency of the section that is shown. */
function paintChaos(context: CanvasRenderingContext2D, frame: Frame, { meta, state, theme }: Scene): void {
    if (state.off.has("chaos")) {
        return;
    }
    const { top, height } = frame.plot.bbox;
    for (const [low, high] of meta.chaos) {
        const left = frame.toX(low);
        const width = Math.max(frame.density, frame.toX(high) - left);
        context.fillStyle = theme.look.shade;
        context.fillRect(left, top, width, height);
        context.fillStyle = theme.look.pale;
        context.fillRect(left, top, width, 0.5 * STRIP * frame.density);
    }
    const section = meta.sections[state.section];
    if (section !== undefined) {
        context.strokeStyle = theme.look.pale;
        context.lineWidth = 1.5 * frame.density;
        context.setLineDash([2 * frame.density, 3 * frame.density]);
        context.beginPath();
        context.moveTo(frame.toX(section.frequency), top);
        context.lineTo(frame.toX(section.frequency), top + height);
        context.stroke();
    }
}

/** Strokes across the lines of a branch, in canvas pixels. */
function strokesOf(count: number, density: number): Strokes {
    return { count, spacing: 48 * density, apart: 3 * density, reach: 5 * density };
}

function paintBranches(context: CanvasRenderingContext2D, frame: Frame, scene: Scene, scales: Scales): number {
    const { meta, solutions, curves, state, theme } = scene;
    const levels = curves.levels(state.quantity, state.log);
    const density = frame.density;
    let drawn = 0;
    context.lineJoin = "round";
    meta.branches.forEach((branch, place) => {
        if (state.hidden.has(place) || branch.count === 0) {
            return;
        }
        const lines = linesOf(solutions, levels, branch.first, branch.count, scales, strokesOf(theme.strokes(branch.period), density));
        context.strokeStyle = context.fillStyle = theme.period(branch.period);
        context.lineWidth = 1.1 * density;
        context.setLineDash([5 * density, 3 * density]);
        context.stroke(lines.unstable);
        context.lineWidth = 2 * density;
        context.setLineDash(DOTS.map((length) => length * density));
        context.stroke(lines.marginal);
        context.setLineDash([]);
        context.stroke(lines.stable);
        context.lineWidth = 1.1 * density;
        context.stroke(lines.strokes);
        for (const [x, y, look] of lines.dots) {
            context.beginPath();
            context.arc(x, y, 3 * density, 0, 2 * Math.PI);
            if (look === "stable") {
                context.fill();
            } else {
                context.lineWidth = (look === "marginal" ? 2 : 1.1) * density;
                context.stroke();
            }
        }
        drawn++;
    });
    return drawn;
}

function paintMarks(context: CanvasRenderingContext2D, frame: Frame, scene: Scene, scales: Scales, isBehind: boolean): void {
    for (const mark of MARKS.filter(({ isPale }) => isPale === isBehind)) {
        const others = MARKS.filter(standsFor(mark)).flatMap((other) => placesOf(other, scene, scales));
        drawMarks(context, mark, apart(placesOf(mark, scene, scales), others, frame.density), frame.density, scene.theme.look);
    }
}

/** Where a mark is seen (canvas pixels). */
function placesOf(mark: Mark, { solutions, curves, state, marked }: Scene, scales: Scales): [number, number][] {
    const levels = curves.levels(state.quantity, state.log);
    const { left, top, width, height } = scales;
    const places = (marked.get(mark) ?? []).filter((k) => !state.hidden.has(solutions.branch[k] ?? 0)).map((k) => placeOf(solutions, levels, k, scales));
    return places.filter(([x, y]) => x >= left && x <= left + width && y >= top && y <= top + height);
}

function placeOf(solutions: Solutions, levels: Float64Array, k: number, scales: Scales): [number, number] {
    return [
        scales.left + ((solutions.frequency[k] ?? NaN) - scales.lowX) * scales.perX,
        scales.top + scales.height - ((levels[k] ?? NaN) - scales.lowY) * scales.perY,
    ];
}

/** Measured points, and motions that do not repeat behind them. */
function paintOverlay(context: CanvasRenderingContext2D, frame: Frame, { meta, state, theme }: Scene): void {
    const dots = dotsOf(meta, state);
    for (const layer of [...LAYERS].reverse()) {
        if (layer !== "chaos") {
            const places = dots.filter((dot) => dot.layer === layer).map((dot) => [frame.toX(dot.frequency), frame.toY(dot.value)] as const);
            drawDots(context, layer, places, frame.density, theme.look);
        }
    }
}

function paintSelected(context: CanvasRenderingContext2D, frame: Frame, scene: Scene, scales: Scales): void {
    const { solutions, curves, state, theme } = scene;
    if (state.selected < 0) {
        return;
    }
    const [x, y] = placeOf(solutions, curves.levels(state.quantity, state.log), state.selected, scales);
    const density = frame.density;
    context.setLineDash([]);
    for (const [width, colour] of [[5, theme.look.paper], [2.2, theme.look.ink]] as const) {
        context.beginPath();
        context.arc(x, y, 7 * density, 0, 2 * Math.PI);
        context.lineWidth = width * density;
        context.strokeStyle = colour;
        context.stroke();
    }
}
