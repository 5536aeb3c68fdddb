// What lies in the frame of the response diagram, from back to front.

import { scalesOf, type Curves, type Scales } from "./curves";
import type { Meta, Solutions } from "./data";
import { MEASURES } from "./format";
import type { Frame } from "./frame";
import { drawMarks, MARKS, type Mark } from "./marks";
import { linesOf } from "./paths";
import type { State } from "./state";
import type { Theme } from "./theme";

export interface Scene {
    meta: Meta;
    solutions: Solutions;
    curves: Curves;
    state: State;
    theme: Theme;
    marked: Map<Mark, number[]>;
}

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
    if (scene.state.measured) {
        paintMeasured(context, frame, scene);
    }
    paintSelected(context, frame, scene, scales);
    return drawn;
}

/** Chaotic ranges, and the frequency of the section that is shown. */
function paintChaos(context: CanvasRenderingContext2D, frame: Frame, { meta, state, theme }: Scene): void {
    const { top, height } = frame.plot.bbox;
    context.fillStyle = theme.look.shade;
    for (const [low, high] of meta.chaos) {
        const left = frame.toX(low);
        context.fillRect(left, top, Math.max(frame.density, frame.toX(high) - left), height);
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
        const lines = linesOf(solutions, levels, branch.first, branch.count, scales);
        context.strokeStyle = context.fillStyle = theme.period(branch.period);
        context.lineWidth = 1.1 * density;
        context.setLineDash([5 * density, 3 * density]);
        context.stroke(lines.unstable);
        context.lineWidth = 2 * density;
        context.setLineDash([]);
        context.stroke(lines.stable);
        for (const [x, y, isStable] of lines.dots) {
            context.beginPath();
            context.arc(x, y, 3 * density, 0, 2 * Math.PI);
            if (isStable) {
                context.fill();
            } else {
                context.stroke();
            }
        }
        drawn++;
    });
    return drawn;
}

function paintMarks(context: CanvasRenderingContext2D, frame: Frame, scene: Scene, scales: Scales, isBehind: boolean): void {
    const { solutions, curves, state, theme, marked } = scene;
    const levels = curves.levels(state.quantity, state.log);
    const { left, top, width, height } = scales;
    for (const mark of MARKS.filter(({ isPale }) => isPale === isBehind)) {
        const places: [number, number][] = [];
        for (const k of marked.get(mark) ?? []) {
            const [x, y] = placeOf(solutions, levels, k, scales);
            if (x >= left && x <= left + width && y >= top && y <= top + height && !state.hidden.has(solutions.branch[k] ?? 0)) {
                places.push([x, y]);
            }
        }
        drawMarks(context, mark, places, frame.density, theme.look);
    }
}

function placeOf(solutions: Solutions, levels: Float64Array, k: number, scales: Scales): [number, number] {
    return [
        scales.left + ((solutions.frequency[k] ?? NaN) - scales.lowX) * scales.perX,
        scales.top + scales.height - ((levels[k] ?? NaN) - scales.lowY) * scales.perY,
    ];
}

/** Measured points, and the largest displacements of motions that do not repeat. */
function paintMeasured(context: CanvasRenderingContext2D, frame: Frame, { meta, state, theme }: Scene): void {
    const density = frame.density;
    const { factor } = MEASURES[state.quantity];
    const cross = (x: number, y: number, radius: number): void => {
        context.moveTo(x - radius, y - radius);
        context.lineTo(x + radius, y + radius);
        context.moveTo(x - radius, y + radius);
        context.lineTo(x + radius, y - radius);
    };
    context.setLineDash([]);
    context.lineWidth = 1.3 * density;
    context.strokeStyle = theme.look.ink;
    context.beginPath();
    for (const series of meta.measured) {
        const points = state.quantity === "displacement" ? series.displacement : state.quantity === "acceleration" ? series.acceleration : [];
        for (const [frequency, value] of points) {
            if (frequency !== null && value !== null) {
                cross(frame.toX(frequency), frame.toY(factor * value), 3 * density);
            }
        }
    }
    context.stroke();
    if (state.quantity === "displacement") {
        context.fillStyle = theme.look.pale;
        for (const { frequency, displacement } of meta.motions) {
            if (displacement !== null) {
                context.beginPath();
                context.arc(frame.toX(frequency), frame.toY(factor * displacement), 2 * density, 0, 2 * Math.PI);
                context.fill();
            }
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
