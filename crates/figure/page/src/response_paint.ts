// What lies in the frame of the response diagram, from back to front.

import { scalesOf, type Curves, type Scales } from "./curves";
import { isOverFrequency, STRIP } from "./chaos";
import { paintCompared, type Compared } from "./compared";
import type { Meta, Solutions } from "./data";
import type { Frame } from "./frame";
import { KeptDrawing } from "./kept_drawing";
import { drawMarks, MARKS, type Marked } from "./marks";
import { newPath } from "./outline";
import { dotsOf } from "./overlay";
import { drawDots } from "./overlay_paint";
import type { PlacedMark } from "./place_marks";
import { DOTS, type State } from "./state";
import type { Theme } from "./theme";
import { MEASURES } from "./units";

export interface Scene {
    meta: Meta;
    solutions: Solutions;
    curves: Curves;
    state: State;
    theme: Theme;
    marked: readonly Marked[];
    /** Numbers of special points by their solutions. */
    numbers: ReadonlyMap<number, number>;
    compared: readonly Compared[];
    /** What is kept while one pans; without it everything is made anew. */
    kept?: KeptDrawing;
}

/** Dots of marginal lines and the gaps between (CSS pixels). */
export const DOTTED: readonly number[] = [2, 3];
export const SANS = "system-ui, -apple-system, 'Segoe UI', Roboto, Helvetica, Arial, sans-serif";

/** Kinds of lines, with their widths and dashes (CSS pixels), from back to front. */
const LINES: readonly (readonly ["unstable" | "marginal" | "stable", number, readonly number[]])[] = [
    ["unstable", 1.1, [5, 3]],
    ["marginal", 2, DOTTED],
    ["stable", 2, []],
];

/** Draws everything; returns the number of branches of which something was drawn. */
export function paintResponse(context: CanvasRenderingContext2D, frame: Frame, scene: Scene): number {
    const scales = scalesOf(frame.range(), frame.plot.bbox);
    const kept = scene.kept ?? new KeptDrawing();
    const shift = kept.shiftTo(scene, scales, frame.density);
    const marks = shiftedMarks(kept, scene, shift);
    paintChaos(context, frame, scene);
    paintMarks(context, frame, scene, marks, true);
    paintCompared(context, frame, scene, scales);
    const drawn = paintBranches(context, frame, scene, { kept, shift });
    paintMarks(context, frame, scene, marks, false);
    paintNumbers(context, frame, scene, marks);
    paintOverlay(context, frame, scene);
    paintSelected(context, frame, scene, scales);
    return drawn;
}

/** Chaotic ranges with a strip above them, and the frequency of the section that is shown. */
function paintChaos(context: CanvasRenderingContext2D, frame: Frame, { meta, state, theme }: Scene): void {
    if (state.off.has("chaos") || !isOverFrequency(state)) {
        return;
    }
    const { factor } = MEASURES.frequency;
    const toX = (hertz: number): number => frame.toX(factor * hertz);
    const { top, height } = frame.plot.bbox;
    for (const [low, high] of meta.chaos) {
        const left = toX(low);
        const width = Math.max(frame.density, toX(high) - left);
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
        const line = newPath();
        line.moveTo(toX(section.frequency), top);
        line.lineTo(toX(section.frequency), top + height);
        context.stroke(line as Path2D);
    }
}

function paintBranches(
    context: CanvasRenderingContext2D,
    frame: Frame,
    scene: Scene,
    { kept, shift }: { kept: KeptDrawing; shift: readonly [number, number] },
): number {
    const { meta, state, theme } = scene;
    const density = frame.density;
    let drawn = 0;
    context.lineJoin = "round";
    context.save();
    context.translate(...shift);
    meta.branches.forEach(({ count, period }, place) => {
        const lines = state.hidden.has(place) || count === 0 ? null : kept.linesOf(scene, place);
        if (lines === null) {
            return;
        }
        context.strokeStyle = context.fillStyle = theme.period(period);
        for (const [look, width, dash] of LINES.filter(([look]) => !state.off.has(look))) {
            context.lineWidth = width * density;
            context.setLineDash(dash.map((length) => length * density));
            context.stroke(lines[look] as Path2D);
        }
        context.setLineDash([]);
        context.lineWidth = 1.1 * density;
        context.stroke(lines.strokes as Path2D);
        for (const [x, y, look] of lines.dots.filter(([, , look]) => !state.off.has(look))) {
            const dot = newPath();
            dot.arc(x, y, 3 * density, 0, 2 * Math.PI);
            if (look === "stable") {
                context.fill(dot as Path2D);
            } else {
                context.lineWidth = (look === "marginal" ? 2 : 1.1) * density;
                context.stroke(dot as Path2D);
            }
        }
        drawn++;
    });
    context.restore();
    return drawn;
}

/** The marks that are drawn, with their places. */
export function marksOf(frame: Frame, scene: Scene): PlacedMark[] {
    const kept = scene.kept ?? new KeptDrawing();
    return shiftedMarks(
        kept,
        scene,
        kept.shiftTo(scene, scalesOf(frame.range(), frame.plot.bbox), frame.density),
    );
}

function shiftedMarks(
    kept: KeptDrawing,
    scene: Scene,
    [across, down]: readonly [number, number],
): PlacedMark[] {
    return scene.state.marks
        ? kept.marksOf(scene).map((one) => ({ ...one, at: [one.at[0] + across, one.at[1] + down] }))
        : [];
}

function paintMarks(
    context: CanvasRenderingContext2D,
    frame: Frame,
    { theme }: Scene,
    placed: readonly PlacedMark[],
    isBehind: boolean,
): void {
    for (const mark of MARKS.filter(({ isPale }) => isPale === isBehind).toReversed()) {
        const places = placed.filter((one) => one.mark === mark).map(({ at }) => at);
        if (places.length > 0) {
            drawMarks(context, mark, places, frame.density, theme.look);
        }
    }
}

/** Numbers of special points beside their marks, where one has room. */
function paintNumbers(
    context: CanvasRenderingContext2D,
    frame: Frame,
    { state, theme, numbers }: Scene,
    placed: readonly PlacedMark[],
): void {
    if (!state.numbers) {
        return;
    }
    const density = frame.density;
    context.font = `${11 * density}px ${SANS}`;
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.lineJoin = "round";
    const boxes: [number, number, number][] = [];
    for (const {
        solution,
        at: [x, y],
        mark,
    } of placed.filter((one) => one.mark.layer !== "grazing")) {
        const isSeen =
            y > frame.plot.bbox.top + 6 * density &&
            y < frame.plot.bbox.top + frame.plot.bbox.height - 6 * density;
        const text = isSeen ? String(numbers.get(solution) ?? "") : "";
        const width = 7 * density * text.length + 2 * density;
        const right = x + mark.room * density;
        // Beside the right edge it stands on the left.
        const fits = right + width <= frame.plot.bbox.left + frame.plot.bbox.width;
        const box: [number, number, number] = [
            fits ? right : x - mark.room * density - width,
            y - 7 * density,
            width,
        ];
        const isFree = boxes.every(
            ([left, top, width]) =>
                Math.abs(top - box[1]) > 12 * density || box[0] > left + width || box[0] + box[2] < left,
        );
        const coversMark = placed.some(
            (other) =>
                other.solution !== solution &&
                other.at[0] > box[0] - 3 * density &&
                other.at[0] < box[0] + box[2] &&
                Math.abs(other.at[1] - y) < 9 * density,
        );
        if (text !== "" && isFree && !coversMark) {
            boxes.push(box);
            context.lineWidth = 3 * density;
            context.strokeStyle = theme.look.paper;
            context.strokeText(text, box[0], box[1]);
            context.fillStyle = theme.look.ink;
            context.fillText(text, box[0], box[1]);
        }
    }
}

function placeOf(across: Float64Array, levels: Float64Array, k: number, scales: Scales): [number, number] {
    return [
        scales.left + ((across[k] ?? NaN) - scales.lowX) * scales.perX,
        scales.top + scales.height - ((levels[k] ?? NaN) - scales.lowY) * scales.perY,
    ];
}

/** Measured points, and motions that do not repeat behind them. */
function paintOverlay(context: CanvasRenderingContext2D, frame: Frame, { meta, state, theme }: Scene): void {
    const dots = dotsOf(meta, state);
    for (const layer of DOTS.toReversed()) {
        const places = dots
            .filter((dot) => dot.layer === layer)
            .map((dot) => [frame.toX(dot.x), frame.toY(dot.value)] as const);
        if (places.length > 0) {
            drawDots(context, layer, places, frame.density, theme.look);
        }
    }
}

function paintSelected(context: CanvasRenderingContext2D, frame: Frame, scene: Scene, scales: Scales): void {
    const { solutions, curves, state, theme } = scene;
    if (state.selected < 0 || state.hidden.has(solutions.branch[state.selected] ?? 0)) {
        return;
    }
    const [x, y] = placeOf(curves.across(state), curves.levels(state), state.selected, scales);
    if (!Number.isFinite(x + y)) {
        return;
    }
    const density = frame.density;
    context.setLineDash([]);
    for (const [width, colour] of [
        [5, theme.look.paper],
        [2.2, theme.look.ink],
    ] as const) {
        const ring = newPath();
        ring.arc(x, y, 7 * density, 0, 2 * Math.PI);
        context.lineWidth = width * density;
        context.strokeStyle = colour;
        context.stroke(ring as Path2D);
    }
}
