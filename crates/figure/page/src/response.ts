// The response diagram: its view, zoom and pan, hover and click.

import { nearestSection } from "./chaos";
import type { Curves } from "./curves";
import type { Meta, Solutions } from "./data";
import { element } from "./dom";
import { MEASURES } from "./format";
import { Frame, NARROWEST, type Range } from "./frame";
import { markedSolutions } from "./marks";
import { dotsOf } from "./overlay";
import { pick, type Picked } from "./pick";
import { paintResponse } from "./response_paint";
import type { Store, View } from "./state";
import type { Theme } from "./theme";
import { tipText } from "./tip";

/** Height of the diagram on paper (CSS pixels). */
const PRINTED_HEIGHT = 440;

export class Response {
    readonly host = element("div", { class: "response", tabindex: "0", role: "application", "aria-label": "Response diagram" });
    private readonly tip = element("div", { class: "tip", role: "status" });
    private readonly frame: Frame;
    private planned = false;

    constructor(
        private readonly meta: Meta,
        private readonly solutions: Solutions,
        private readonly curves: Curves,
        private readonly store: Store,
        theme: Theme,
        private readonly openSection: (place: number) => void,
        parent: HTMLElement,
    ) {
        parent.append(this.host, this.tip);
        const marked = markedSolutions(solutions);
        this.frame = new Frame(
            this.host,
            {
                xLabel: () => "Excitation frequency (Hz)",
                yLabel: () => MEASURES[store.state.quantity].label,
                range: () => this.range(),
                paint: (context, frame) => {
                    const scene = { meta, solutions, curves, state: store.state, theme, marked };
                    this.host.dataset["branches"] = String(paintResponse(context, frame, scene));
                },
                height: () => (theme.printing ? PRINTED_HEIGHT : Math.round(Math.max(320, Math.min(620, 0.58 * window.innerHeight)))),
            },
            theme,
        );
        this.frame.whenMade(() => this.attach());
        store.listen((_, changed) => {
            if (["quantity", "log", "view", "selected", "hidden", "marks", "off", "shifted", "section"].some((key) => changed.has(key as never))) {
                this.plan();
            }
        });
    }

    /** Draws at the next frame of the screen, once for all that happens until then. */
    private plan(): void {
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
        const { quantity, log } = this.store.state;
        const level = this.curves.levels(quantity, log)[solution] ?? NaN;
        return this.pointAt(this.solutions.frequency[solution] ?? NaN, log ? 10 ** level : level);
    }

    private range(): Range {
        const { quantity, log, view, hidden } = this.store.state;
        const whole = this.whole();
        if (view === null) {
            return whole;
        }
        const y = log && view.y[0] <= 0 ? (this.curves.extent(quantity, log, hidden) ?? [0.1, 1]) : view.y;
        return { x: view.x, y, logY: log };
    }

    /** The range in which everything is seen. */
    private whole(): Range {
        const { quantity, log, hidden } = this.store.state;
        const [low, high] = this.meta.range;
        const over = dotsOf(this.meta, this.store.state).filter(({ frequency }) => frequency >= low && frequency <= high);
        const y = this.curves.extent(quantity, log, hidden, over.map(({ value }) => value));
        return { x: this.meta.range, y: y ?? (log ? [0.1, 1] : [0, 1]), logY: log };
    }

    /** Where a place of the diagram is, in the units of its axes (CSS pixels of the window). */
    pointAt(frequency: number, value: number): [number, number] {
        const box = this.frame.plot.over.getBoundingClientRect();
        return [box.left + this.frame.plot.valToPos(frequency, "x"), box.top + this.frame.plot.valToPos(value, "y")];
    }

    /** Shows all of a range of the frequency, with something on both sides. */
    showRange([low, high]: [number, number]): void {
        const margin = 0.1 * (high - low) || 0.01 * (this.meta.range[1] - this.meta.range[0]);
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
        const { quantity, log, selected } = this.store.state;
        const { x, y, logY } = this.range();
        const [low, high] = logY ? [Math.log10(y[0]), Math.log10(y[1])] : y;
        const across = ((this.solutions.frequency[selected] ?? NaN) - x[0]) / (x[1] - x[0]);
        const up = ((this.curves.levels(quantity, log)[selected] ?? NaN) - low) / (high - low);
        const isSeen = across >= 0 && across <= 1 && up >= 0 && up <= 1;
        this.zoom([factor, factor], isSeen ? [across, up] : [0.5, 0.5]);
    }

    /** Moves by shares of width and height. */
    pan(by: [number, number]): void {
        this.change((low, high, axis) => [low + by[axis] * (high - low), high + by[axis] * (high - low)]);
    }

    /** Goes to where a solution is seen, as near as now or nearer. */
    show(solution: number, shareOfRange: number): void {
        const { quantity, log } = this.store.state;
        const level = this.curves.levels(quantity, log)[solution];
        const at = [this.solutions.frequency[solution], level];
        const whole = this.whole();
        this.change((low, high, axis) => {
            const [from, to] = axis === 0 ? whole.x : (log ? whole.y.map(Math.log10) : whole.y);
            const half = Math.min(0.5 * (high - low), 0.5 * shareOfRange * ((to ?? 1) - (from ?? 0)));
            const middle = at[axis];
            return middle === undefined || !Number.isFinite(middle) ? [low, high] : [middle - half, middle + half];
        });
    }

    /** Moves the view to a solution that is not in it. */
    follow(solution: number): void {
        const { quantity, log, view } = this.store.state;
        const at = [this.solutions.frequency[solution], this.curves.levels(quantity, log)[solution]];
        if (view !== null) {
            this.change((low, high, axis) => {
                const place = at[axis];
                const isSeen = place === undefined || !Number.isFinite(place) || (place >= low && place <= high);
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
        const enough = (low: number, high: number): boolean => high - low > 2 * NARROWEST * Math.max(Math.abs(low), Math.abs(high));
        if (enough(...view.x) && enough(...view.y) && across[1] - across[0] < 1e6) {
            this.store.update({ view });
        }
    }

    private pick(left: number, top: number): Picked | null {
        return pick(this.meta, this.curves, this.store.state, this.frame, left, top);
    }

    /** A click: on a solution, or on a measured point beside one, its orbit, on a motion that does not repeat or a chaotic range the nearest section. */
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
            this.openSection(this.meta.sections.findIndex((section) => section.frequency === frequency && section.kind === kind));
        } else if (picked.beside >= 0) {
            this.store.update({ selected: picked.beside });
        }
    }

    private attach(): void {
        const over = this.frame.plot.over;
        const shares = (event: PointerEvent | WheelEvent): [number, number] => {
            const box = over.getBoundingClientRect();
            return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
        };
        over.addEventListener("wheel", (event) => {
            event.preventDefault();
            const factor = Math.exp(Math.max(-1, Math.min(1, event.deltaY / 300)));
            this.zoom([event.altKey ? 1 : factor, event.shiftKey ? 1 : factor], shares(event));
        }, { passive: false });
        over.addEventListener("dblclick", () => this.store.update({ view: null }));
        over.addEventListener("pointerleave", () => this.hide());
        over.addEventListener("contextmenu", (event) => event.preventDefault());
        over.addEventListener("pointerdown", (event) => this.drag(over, event, shares));
        over.addEventListener("pointermove", (event) => {
            if (event.buttons === 0) {
                this.hover(event.offsetX, event.offsetY);
            }
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

    /** A press that moves zooms into a box, or pans with shift or another button; one that does not selects. */
    private drag(over: HTMLElement, down: PointerEvent, shares: (event: PointerEvent) => [number, number]): void {
        over.setPointerCapture(down.pointerId);
        this.hide();
        const pans = down.shiftKey || down.button !== 0 || down.pointerType === "touch";
        const box = element("div", { class: "zoom-box" });
        let [moved, last] = [false, shares(down)];
        const first = last;
        const move = (event: PointerEvent): void => {
            moved ||= Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) > 4;
            const now = shares(event);
            if (moved && pans) {
                this.pan([last[0] - now[0], last[1] - now[1]]);
                last = now;
            } else if (moved) {
                over.append(box);
                const [left, right] = [Math.min(first[0], now[0]), Math.max(first[0], now[0])];
                const [low, high] = [Math.min(first[1], now[1]), Math.max(first[1], now[1])];
                box.style.cssText = `left:${100 * left}%;width:${100 * (right - left)}%;top:${100 * (1 - high)}%;height:${100 * (high - low)}%`;
            }
        };
        const up = (event: PointerEvent): void => {
            over.removeEventListener("pointermove", move);
            over.removeEventListener("pointercancel", up);
            box.remove();
            if (event.type === "pointercancel") {
                return;
            }
            const now = shares(event);
            if (!moved) {
                this.choose(this.pick(event.offsetX, event.offsetY));
            } else if (!pans && now[0] !== first[0] && now[1] !== first[1]) {
                this.change((low, high, axis) => {
                    const ends = [first[axis], now[axis]].sort((a, b) => a - b);
                    return [low + (ends[0] ?? 0) * (high - low), low + (ends[1] ?? 1) * (high - low)];
                });
            }
        };
        over.addEventListener("pointermove", move);
        over.addEventListener("pointerup", up, { once: true });
        over.addEventListener("pointercancel", up, { once: true });
    }
}
