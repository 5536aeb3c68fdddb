// The response diagram: its view, zoom and pan, hover and click.

import { isOverFrequency, nearestSection } from "./chaos";
import type { Compared } from "./compared";
import type { Curves } from "./curves";
import type { Meta, Solutions } from "./data";
import { element } from "./dom";
import { Frame, NARROWEST, type Range } from "./frame";
import { listenToGestures } from "./gestures";
import { KeptDrawing } from "./kept_drawing";
import type { Marked } from "./marks";
import { dotsOf } from "./overlay";
import { pick, type Picked } from "./pick";
import { paintResponse, type Scene } from "./response_paint";
import type { Store, View } from "./state";
import type { Theme } from "./theme";
import { tipText } from "./tip";
import { axisLabel, measureOf, MEASURES } from "./units";

/** Height of the diagram on paper (CSS pixels). */
const PRINTED_HEIGHT = 440;

const NONE: ReadonlySet<number> = new Set();

export class Response {
    readonly host = element("div", {
        class: "response",
        tabindex: "0",
        role: "application",
        "aria-label": "Response diagram: arrow keys go along the branches, ? lists all keys",
    });
    private readonly tip = element("div", { class: "tip", role: "status" });
    readonly frame: Frame;
    private readonly kept = new KeptDrawing();
    private planned = false;

    constructor(
        private readonly meta: Meta,
        private readonly solutions: Solutions,
        private readonly curves: Curves,
        private readonly store: Store,
        private readonly theme: Theme,
        private readonly over: {
            marked: readonly Marked[];
            numbers: ReadonlyMap<number, number>;
            compared: readonly Compared[];
        },
        private readonly openSection: (place: number) => void,
        parent: HTMLElement,
    ) {
        parent.append(this.host, this.tip);
        this.frame = new Frame(
            this.host,
            {
                xLabel: () => axisLabel(measureOf(meta, store.state.across, store.state.over)),
                yLabel: () => axisLabel(measureOf(meta, store.state.quantity, store.state.over)),
                range: () => this.range(),
                paint: (context, frame) =>
                    (this.host.dataset["branches"] = String(paintResponse(context, frame, this.scene()))),
                height: () =>
                    theme.printing
                        ? PRINTED_HEIGHT
                        : Math.round(Math.max(320, Math.min(620, 0.58 * window.innerHeight))),
            },
            theme,
        );
        this.frame.whenMade(() => this.attach());
        store.listen((_, changed) => {
            if ([...changed].some((key) => key !== "theme")) {
                this.plan();
            }
        });
    }

    /** What is drawn now. */
    scene(): Scene {
        return {
            meta: this.meta,
            solutions: this.solutions,
            curves: this.curves,
            state: this.store.state,
            theme: this.theme,
            kept: this.kept,
            ...this.over,
        };
    }

    /** Draws at the next frame of the screen, once for all that happens until then. */
    plan(): void {
        if (!this.planned) {
            this.planned = true;
            requestAnimationFrame(() => {
                this.planned = false;
                this.frame.redraw();
            });
        }
    }

    /** Draws at once; for measuring how long that takes. */
    redraw(): void {
        this.frame.redraw();
    }

    /** Where a solution is drawn (CSS pixels of the window). */
    placeOf(solution: number): [number, number] {
        const { quantity, over } = this.store.state;
        return this.pointAt(
            this.curves.across(this.store.state)[solution] ?? NaN,
            this.curves.values(quantity, over)[solution] ?? NaN,
        );
    }

    private range(): Range {
        const { log, view } = this.store.state;
        if (view === null) {
            return this.whole();
        }
        const y = log && view.y[0] <= 0 ? (this.curves.upright(this.store.state) ?? [0.1, 1]) : view.y;
        return { x: view.x, y, logY: log };
    }

    /** The range in which everything is seen. */
    private whole(): Range {
        const { state } = this.store;
        const { factor } = MEASURES.frequency;
        const [low, high] = this.meta.range;
        const over = dotsOf(this.meta, state)
            .filter(({ frequency }) => frequency >= low && frequency <= high)
            .map(({ value }) => value);
        const others =
            state.over !== 0
                ? []
                : this.over.compared
                      .filter(({ isDrawn }) => isDrawn)
                      .flatMap(({ curves }) => curves.upright({ ...state, hidden: NONE }) ?? []);
        const y = this.curves.upright(state, [...over, ...others]);
        const x = isOverFrequency(state)
            ? ([factor * low, factor * high] as [number, number])
            : (this.curves.extent(this.curves.across(state), state.hidden) ?? [0, 1]);
        return { x, y: y ?? (state.log ? [0.1, 1] : [0, 1]), logY: state.log };
    }

    /** Where a place of the diagram is, in the units of its axes (CSS pixels of the window). */
    pointAt(across: number, value: number): [number, number] {
        const box = this.frame.plot.over.getBoundingClientRect();
        return [
            box.left + this.frame.plot.valToPos(across, "x"),
            box.top + this.frame.plot.valToPos(value, "y"),
        ];
    }

    /** Shows all of a range of the frequency (Hz), with something on both sides. */
    showRange(range: [number, number]): void {
        const { factor } = MEASURES.frequency;
        const [low, high] = [factor * range[0], factor * range[1]];
        const margin = 0.1 * (high - low) || 0.01 * factor * (this.meta.range[1] - this.meta.range[0]);
        this.store.update({
            across: "parameter",
            view: this.store.state.across === "parameter" ? this.store.state.view : null,
        });
        this.change((from, to, axis) => (axis === 0 ? [low - margin, high + margin] : [from, to]));
    }

    /** Zooms by a factor about a place, given as shares of width and height from below. */
    zoom(factor: [number, number], about: [number, number] = [0.5, 0.5]): void {
        this.change((low, high, axis) => {
            const fixed = low + about[axis] * (high - low);
            return [fixed + factor[axis] * (low - fixed), fixed + factor[axis] * (high - fixed)];
        });
    }

    /** Zooms about the selected solution where it is seen, else about the middle. */
    zoomAboutSelected(factor: number): void {
        const { selected } = this.store.state;
        const { x, y, logY } = this.range();
        const [low, high] = logY ? [Math.log10(y[0]), Math.log10(y[1])] : y;
        const across = ((this.curves.across(this.store.state)[selected] ?? NaN) - x[0]) / (x[1] - x[0]);
        const up = ((this.curves.levels(this.store.state)[selected] ?? NaN) - low) / (high - low);
        const isSeen = across >= 0 && across <= 1 && up >= 0 && up <= 1;
        this.zoom([factor, factor], isSeen ? [across, up] : [0.5, 0.5]);
    }

    /** Moves by shares of width and height. */
    pan(by: [number, number]): void {
        this.change((low, high, axis) => [low + by[axis] * (high - low), high + by[axis] * (high - low)]);
    }

    /** Goes to where a solution is seen, as near as now or nearer. */
    show(solution: number, shareOfRange: number): void {
        const { log } = this.store.state;
        const at = this.place(solution);
        const whole = this.whole();
        this.change((low, high, axis) => {
            const [from, to] = axis === 0 ? whole.x : log ? whole.y.map(Math.log10) : whole.y;
            const half = Math.min(0.5 * (high - low), 0.5 * shareOfRange * ((to ?? 1) - (from ?? 0)));
            const middle = at[axis];
            return middle === undefined || !Number.isFinite(middle)
                ? [low, high]
                : [middle - half, middle + half];
        });
    }

    /** Values of a solution on both axes, as they are drawn. */
    private place(solution: number): [number | undefined, number | undefined] {
        return [
            this.curves.across(this.store.state)[solution],
            this.curves.levels(this.store.state)[solution],
        ];
    }

    /** Moves the view to a solution that is not in it. */
    follow(solution: number): void {
        const at = this.place(solution);
        if (this.store.state.view !== null) {
            this.change((low, high, axis) => {
                const place = at[axis];
                const isSeen =
                    place === undefined || !Number.isFinite(place) || (place >= low && place <= high);
                const half = 0.5 * (high - low);
                return isSeen ? [low, high] : [place - half, place + half];
            });
        }
    }

    /** Changes the ends of both axes, levels of a logarithmic one. */
    private change(of: (low: number, high: number, axis: 0 | 1) => [number, number]): void {
        const { x, y, logY } = this.range();
        const across = of(x[0], x[1], 0);
        const up = logY ? of(Math.log10(y[0]), Math.log10(y[1]), 1) : of(y[0], y[1], 1);
        const view: View = { x: across, y: logY ? [10 ** up[0], 10 ** up[1]] : up };
        const enough = (low: number, high: number): boolean =>
            high - low > 2 * NARROWEST * Math.max(Math.abs(low), Math.abs(high));
        if (enough(...view.x) && enough(...view.y) && across[1] - across[0] < 1e9) {
            this.store.update({ view });
        }
    }

    private pick(left: number, top: number): Picked | null {
        return pick(this.meta, this.curves, this.store.state, this.frame, left, top);
    }

    /**
     * A click: on a solution, or on a measured point beside one, its orbit, on a motion that does not
     * repeat or a chaotic range the nearest section.
     */
    private choose(picked: Picked | null): void {
        if (picked === null) {
            return;
        }
        if ("solution" in picked) {
            this.store.update({ selected: picked.solution });
        } else if ("range" in picked) {
            this.openSection(nearestSection(this.meta, picked.frequency, picked.range));
        } else if ("motion" in picked.dot.of) {
            const { frequency, kind } = picked.dot.of.motion;
            this.openSection(
                this.meta.sections.findIndex(
                    (section) => section.frequency === frequency && section.kind === kind,
                ),
            );
        } else if (picked.beside >= 0) {
            this.store.update({ selected: picked.beside });
        }
    }

    private attach(): void {
        const over = this.frame.plot.over;
        listenToGestures(over, {
            zoom: (factor, about) => this.zoom(factor, about),
            pan: (by) => this.pan(by),
            box: (first, last) => this.zoomInto(first, last),
            whole: () => this.store.update({ view: null }),
            press: () => this.hide(),
            choose: (left, top) => this.choose(this.pick(left, top)),
            hover: (place) => (place === null ? this.hide() : this.hover(...place)),
        });
    }

    /** Zooms into a box between two places, shares of width and height from below. */
    private zoomInto(first: [number, number], last: [number, number]): void {
        this.change((low, high, axis) => {
            const [from = 0, to = 1] = [first[axis], last[axis]].sort((a, b) => a - b);
            return [low + from * (high - low), low + to * (high - low)];
        });
    }

    private hover(left: number, top: number): void {
        const picked = this.pick(left, top);
        if (picked === null) {
            this.hide();
            return;
        }
        this.tip.replaceChildren(...tipText(this.meta, this.solutions, this.store.state, picked));
        this.tip.classList.add("seen");
        const { over } = this.frame.plot;
        const isRight = left > 0.6 * over.clientWidth;
        this.tip.style.left = `${over.offsetLeft + left + (isRight ? -12 : 14)}px`;
        this.tip.style.top = `${over.offsetTop + top + (top < 110 ? 14 : -12)}px`;
        this.tip.style.transform = `translate(${isRight ? "-100%" : "0"}, ${top < 110 ? "0" : "-100%"})`;
    }

    private hide(): void {
        this.tip.classList.remove("seen");
    }
}
