// What lines, colours and marks of the response diagram mean. Each entry is a switch.

import { isOverFrequency } from "./chaos";
import { comparedColour, type Compared } from "./compared";
import type { Meta, Solutions } from "./data";
import { element } from "./dom";
import { periodName } from "./format";
import { namedMarks, type Marked } from "./marks";
import { newPath } from "./outline";
import { drawDots } from "./overlay_paint";
import { hasMarginal } from "./paths";
import { DOTTED } from "./response_paint";
import type { DotLayer, Layer, State, Store } from "./state";
import type { Theme } from "./theme";

const SIZE = 16;
const MIDDLE = 12;
/** Width of a sample (CSS pixels). */
export const SAMPLE = 24;

type Draw = (context: CanvasRenderingContext2D) => void;

/**
 * An entry: `key` is its layer, `period:N` for a period, `compared:K` for other results; empty for one
 * without a switch.
 */
export interface Entry {
    key: string;
    name: string;
    draw: Draw;
    isOn: boolean;
}

const MEASURED: readonly [DotLayer, string][] = [
    ["periodic", "measured, periodic"],
    ["aperiodic", "measured, aperiodic"],
    ["unknown", "measured, kind unknown"],
];

export interface LegendOf {
    meta: Meta;
    solutions: Solutions;
    marked: readonly Marked[];
    compared: Compared[];
    theme: Theme;
}

/** What the diagram shows, in the order of the legend. */
export function entriesOf({ meta, solutions, marked, compared, theme }: LegendOf, state: State): Entry[] {
    const shown = meta.branches
        .map((branch, place) => ({ ...branch, place }))
        .filter(({ over, count }) => over === state.over && count > 0);
    const periods = [...new Set(shown.map(({ period }) => period))].sort((a, b) => a - b);
    const of = (layer: Layer, name: string, draw: Draw): Entry => ({
        key: layer,
        name,
        draw,
        isOn: !state.off.has(layer),
    });
    const entries: Entry[] = periods.map((period) => ({
        key: `period:${period}`,
        name: periodName(period),
        draw: line(theme.period(period), [], theme.strokes(period)),
        isOn: shown.some((branch) => branch.period === period && !state.hidden.has(branch.place)),
    }));
    entries.push(of("stable", "stable", line(theme.look.ink, [])));
    if (hasMarginal(solutions)) {
        entries.push(of("marginal", "marginal", line(theme.look.ink, DOTTED, 0, 2)));
    }
    entries.push(of("unstable", "unstable", line(theme.look.ink, [4, 3])));
    const own = new Set(shown.map(({ place }) => place));
    const seen = marked.filter(({ solution }) => own.has(solutions.branch[solution] ?? -1));
    for (const [mark, name] of state.marks ? namedMarks(seen, solutions) : []) {
        entries.push(
            of(mark.layer, name, (context) => {
                const path = newPath();
                mark.outline(path, MIDDLE, SIZE / 2, mark.radius);
                context.setLineDash([]);
                context.lineWidth = 1.1;
                context.fillStyle = mark.isFilled ? theme.look.ink : theme.look.paper;
                context.fill(path as Path2D);
                context.strokeStyle = mark.isPale ? theme.look.pale : theme.look.ink;
                context.stroke(path as Path2D);
            }),
        );
    }
    if (isOverFrequency(state)) {
        entries.push(...layers(meta, theme).map(([layer, name, draw]) => of(layer, name, draw)));
        if (meta.sections.length > 0) {
            entries.push({ key: "", name: "the Poincaré section shown", draw: upright(theme), isOn: true });
        }
    }
    compared.forEach(({ name, isDrawn }, place) =>
        entries.push({
            key: `compared:${place}`,
            name,
            draw: line(comparedColour(theme, place), [], 0, 1.6),
            isOn: isDrawn,
        }),
    );
    return entries;
}

/** A line of samples with their names, each a switch; drawn anew when the colours change. */
export function legend(of: LegendOf, store: Store): { root: HTMLElement; fill: () => void } {
    const root = element("div", {
        class: "legend",
        role: "group",
        "aria-label": "Legend: each entry is a switch",
    });
    const fill = (): void => {
        const focused =
            document.activeElement instanceof HTMLElement && root.contains(document.activeElement)
                ? document.activeElement.dataset["layer"]
                : undefined;
        root.replaceChildren(
            ...entriesOf(of, store.state).map((entry) => made(entry, () => press(of, store, entry))),
        );
        root.querySelector<HTMLElement>(`[data-layer="${focused ?? "none"}"]`)?.focus();
    };
    fill();
    of.theme.listen(fill);
    store.listen((_, changed) => {
        if ((["off", "hidden", "over", "across", "marks"] as const).some((key) => changed.has(key))) {
            fill();
        }
    });
    return { root, fill };
}

function press({ meta, compared }: LegendOf, store: Store, { key, isOn }: Entry): void {
    const [kind, number] = key.split(":");
    if (kind === "period") {
        const hidden = new Set(store.state.hidden);
        meta.branches.forEach(({ period, over }, place) => {
            if (period === Number(number) && over === store.state.over) {
                isOn ? hidden.add(place) : hidden.delete(place);
            }
        });
        store.update({ hidden });
    } else if (kind === "compared") {
        const one = compared[Number(number)];
        if (one !== undefined) {
            one.isDrawn = !isOn;
        }
        store.update({ off: new Set(store.state.off) });
    } else {
        const off = new Set(store.state.off);
        isOn ? off.add(key as Layer) : off.delete(key as Layer);
        store.update({ off });
    }
}

/** The layers of which there is something, each with its name and its sample. */
function layers(meta: Meta, theme: Theme): [Layer, string, Draw][] {
    const dot =
        (layer: DotLayer): Draw =>
        (context) =>
            drawDots(context, layer, [[MIDDLE, SIZE / 2]], 1, theme.look);
    const counts = MEASURED.map(([layer]) =>
        meta.measured.reduce(
            (sum, { points }) => sum + points.filter(({ motion }) => motion === layer).length,
            0,
        ),
    );
    const found = MEASURED.filter((_, k) => (counts[k] ?? 0) > 0).map(
        ([layer, name]): [Layer, string, Draw] => [layer, name, dot(layer)],
    );
    if (meta.motions.length > 0) {
        found.push(["irregular", "motion of a sweep that does not repeat", dot("irregular")]);
    }
    if (meta.chaos.length > 0) {
        found.push([
            "chaos",
            "chaotic motion found",
            (context) => {
                context.fillStyle = theme.look.shade;
                context.fillRect(0, 0, SAMPLE, SIZE);
                context.fillStyle = theme.look.pale;
                context.fillRect(0, 0, SAMPLE, 4);
            },
        ]);
    }
    return found;
}

const line =
    (colour: string, dash: readonly number[], strokes = 0, width = dash.length > 0 ? 1.1 : 2): Draw =>
    (context) => {
        const [along, across] = [newPath(), newPath()];
        along.moveTo(0, SIZE / 2);
        along.lineTo(SAMPLE, SIZE / 2);
        for (let k = 0; k < strokes; k++) {
            const x = MIDDLE + 3 * (k - (strokes - 1) / 2);
            across.moveTo(x, SIZE / 2 - 5);
            across.lineTo(x, SIZE / 2 + 5);
        }
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.setLineDash([...dash]);
        context.stroke(along as Path2D);
        context.setLineDash([]);
        context.lineWidth = 1.1;
        context.stroke(across as Path2D);
    };

const upright =
    (theme: Theme): Draw =>
    (context) => {
        const path = newPath();
        path.moveTo(MIDDLE, 0);
        path.lineTo(MIDDLE, SIZE);
        context.strokeStyle = theme.look.pale;
        context.lineWidth = 1.5;
        context.setLineDash([2, 3]);
        context.stroke(path as Path2D);
    };

function made({ key, name, draw, isOn }: Entry, pressed: () => void): HTMLElement {
    const canvas = element("canvas", { "aria-hidden": "true" });
    const density = window.devicePixelRatio;
    [canvas.width, canvas.height] = [SAMPLE * density, SIZE * density];
    canvas.style.cssText = `width:${SAMPLE}px;height:${SIZE}px`;
    const context = canvas.getContext("2d");
    if (context !== null) {
        context.scale(density, density);
        draw(context);
    }
    if (key === "") {
        return element("span", { class: "item" }, [canvas, name]);
    }
    const root = element(
        "button",
        {
            type: "button",
            class: "item",
            title: "On or off",
            "data-layer": key,
            "aria-pressed": String(isOn),
        },
        [canvas, name],
    );
    root.addEventListener("click", pressed);
    return root;
}
