// What lines, colours and marks of the response diagram mean; what lies over the branches has a switch.

import type { Meta, Solutions } from "./data";
import { element } from "./dom";
import { namedMarks } from "./marks";
import type { Dot } from "./overlay";
import { drawDots } from "./overlay_paint";
import { hasMarginal } from "./paths";
import { DOTS } from "./response_paint";
import type { Layer, Store } from "./state";
import type { Theme } from "./theme";

const SIZE = 16;
const MIDDLE = 12;

type Draw = (context: CanvasRenderingContext2D) => void;

const MEASURED: readonly [Dot["layer"], string][] = [
    ["periodic", "measured, periodic"],
    ["aperiodic", "measured, aperiodic"],
    ["unknown", "measured, kind not known"],
];

/** A line of samples with their names; drawn anew when the colours change. */
export function legend(meta: Meta, solutions: Solutions, store: Store, theme: Theme): HTMLElement {
    const marks = namedMarks(solutions);
    const isMarginal = hasMarginal(solutions);
    const root = element("div", { class: "legend", "aria-label": "Legend" });
    const fill = (): void => {
        const periods = [...new Set(meta.branches.map((branch) => branch.period))].sort((a, b) => a - b);
        const items = periods.map((period) => item(`period ${period}`, line(theme.period(period), [], theme.strokes(period))));
        items.push(item("stable", line(theme.look.ink, [])));
        if (isMarginal) {
            items.push(item("marginal", line(theme.look.ink, DOTS, 0, 2)));
        }
        items.push(item("unstable", line(theme.look.ink, [4, 3])));
        items.push(...marks.map(([mark, name]) => item(name, (context) => {
            const path = new Path2D();
            mark.outline(path, MIDDLE, SIZE / 2, mark.radius);
            context.fillStyle = mark.isFilled ? theme.look.ink : theme.look.paper;
            context.fill(path);
            context.strokeStyle = mark.isPale ? theme.look.pale : theme.look.ink;
            context.stroke(path);
        })));
        if (meta.sections.length > 0) {
            items.push(item("the Poincaré section shown", upright(theme)));
        }
        items.push(...layers(meta, theme).map(([layer, name, draw]) => layerSwitch(store, layer, item(name, draw))));
        root.replaceChildren(...items);
    };
    fill();
    theme.listen(fill);
    store.listen((_, changed) => {
        if (changed.has("off")) {
            for (const one of root.querySelectorAll<HTMLElement>("[data-layer]")) {
                one.setAttribute("aria-pressed", String(!store.state.off.has(one.dataset["layer"] as Layer)));
            }
        }
    });
    return root;
}

/** The layers of which there is something, each with its name and its sample. */
function layers(meta: Meta, theme: Theme): [Layer, string, Draw][] {
    const dot = (layer: Dot["layer"]): Draw => (context) => drawDots(context, layer, [[MIDDLE, SIZE / 2]], 1, theme.look);
    const counts = MEASURED.map(([layer]) => meta.measured.reduce((sum, { points }) => sum + points.filter(({ motion }) => motion === layer).length, 0));
    const found = MEASURED.filter((_, k) => (counts[k] ?? 0) > 0).map(([layer, name]): [Layer, string, Draw] => [layer, name, dot(layer)]);
    if (meta.motions.length > 0) {
        found.push(["irregular", "motion of a sweep that does not repeat", dot("irregular")]);
    }
    if (meta.chaos.length > 0) {
        found.push(["chaos", "chaotic motion found", (context) => {
            context.fillStyle = theme.look.shade;
            context.fillRect(0, 0, 24, SIZE);
            context.fillStyle = theme.look.pale;
            context.fillRect(0, 0, 24, 4);
        }]);
    }
    return found;
}

/** An entry of the legend as a switch of its layer. */
function layerSwitch(store: Store, layer: Layer, entry: HTMLElement): HTMLElement {
    const { off } = store.state;
    const made = element("button", { type: "button", class: "item", title: "On or off", "data-layer": layer, "aria-pressed": String(!off.has(layer)) }, [...entry.childNodes]);
    made.addEventListener("click", () => {
        const next = new Set(store.state.off);
        if (!next.delete(layer)) {
            next.add(layer);
        }
        store.update({ off: next });
    });
    return made;
}

const line = (colour: string, dash: readonly number[], strokes = 0, width = dash.length > 0 ? 1.1 : 2): Draw => (context) => {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash([...dash]);
    context.beginPath();
    context.moveTo(0, SIZE / 2);
    context.lineTo(24, SIZE / 2);
    context.stroke();
    context.lineWidth = 1.1;
    context.beginPath();
    for (let k = 0; k < strokes; k++) {
        const x = MIDDLE + 3 * (k - (strokes - 1) / 2);
        context.moveTo(x, SIZE / 2 - 5);
        context.lineTo(x, SIZE / 2 + 5);
    }
    context.stroke();
};

const upright = (theme: Theme): Draw => (context) => {
    context.strokeStyle = theme.look.pale;
    context.lineWidth = 1.5;
    context.setLineDash([2, 3]);
    context.beginPath();
    context.moveTo(MIDDLE, 0);
    context.lineTo(MIDDLE, SIZE);
    context.stroke();
};

function item(name: string, draw: Draw): HTMLElement {
    const canvas = element("canvas", { "aria-hidden": "true" });
    const density = window.devicePixelRatio;
    [canvas.width, canvas.height] = [24 * density, SIZE * density];
    canvas.style.cssText = `width:24px;height:${SIZE}px`;
    const context = canvas.getContext("2d");
    if (context !== null) {
        context.scale(density, density);
        draw(context);
    }
    return element("span", { class: "item" }, [canvas, name]);
}
