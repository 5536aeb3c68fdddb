// A frame with two axes, drawn by uPlot; what lies in it is painted by the caller.

import uPlot from "uplot";

import { commonPart, ticks } from "./format";
import { logAxis, type LogAxis } from "./log_axis";
import type { Theme } from "./theme";

export interface Range {
    x: [number, number];
    y: [number, number];
    logY: boolean;
}

/** Labelled ticks of an axis with their values, and those that have no label. */
export interface Ticks {
    labelled: [value: number, label: string][];
    minor: number[];
}

export interface Painter {
    (context: CanvasRenderingContext2D, frame: Frame): void;
}

export interface FrameOptions {
    xLabel: () => string;
    yLabel: () => string;
    /** The ends of both axes; asked for at every drawing. */
    range: () => Range;
    paint: Painter;
    height: () => number;
    /** Distance of labels on the horizontal axis at least, where they are short (CSS pixels). */
    space?: number;
}

/** Width of the labels of a vertical axis at least (CSS pixels). */
const NARROW = 58;

/** Width and height (CSS pixels) of what lies around a plot whose labels are short. */
export const MARGINS = { across: 96, up: 58 };

/** Least width of an axis, relative to its values: its ticks have to differ. */
export const NARROWEST = 1e-10;

const FONT = "12px system-ui, sans-serif";
const LABEL_FONT = "13px system-ui, sans-serif";

/** Distance of labels on a vertical axis (CSS pixels). */
const TALL = 36;

/** Distance of labels on a horizontal axis: the longest ones have a place there (CSS pixels). */
const WIDE = 76;

/** Width of a character of a label at most (CSS pixels). */
const CHARACTER = 7.8;

/** Room to the right of a plot whose labels are short (CSS pixels). */
const RIGHT = 18;

function logarithmic(plot: uPlot): LogAxis {
    const { min, max } = plot.scales["y"] ?? {};
    return logAxis(min ?? 0.1, max ?? 1, plot.bbox.height / uPlot.pxRatio / TALL);
}

/** What the labels of an axis leave out, at a distance of its ticks. */
function commonOf(plot: uPlot, axis: "x" | "y", distance: number): number {
    const { min, max } = plot.scales[axis] ?? {};
    return commonPart(min ?? 0, max ?? 1, distance);
}

/** A label of an axis that says what is left out at its ticks: "Frequency − 39.69 (Hz)". */
function less(label: string, common: number): string {
    const [name = "", unit = ""] = label.split(/ (?=\([^()]*\)$)/);
    return common === 0
        ? label
        : `${name} ${common > 0 ? "−" : "+"} ${Math.abs(common)}${unit === "" ? "" : ` ${unit}`}`;
}

export class Frame {
    plot: uPlot;
    /** Characters of the last label of the horizontal axis. */
    private lastLabel = 0;
    private logY: boolean;
    /** What the axes have now, labels with what is left out at their ticks. */
    readonly label = { x: "", y: "" };
    readonly ticks: { x: Ticks; y: Ticks } = {
        x: { labelled: [], minor: [] },
        y: { labelled: [], minor: [] },
    };
    private readonly listeners: (() => void)[] = [];

    constructor(
        readonly host: HTMLElement,
        private readonly options: FrameOptions,
        private readonly theme: Theme,
    ) {
        this.logY = options.range().logY;
        this.plot = this.create();
        new ResizeObserver(() => this.resize()).observe(host);
        theme.listen(() => {
            this.resize();
            this.redraw();
        });
    }

    /** Calls now, and again whenever the elements of the plot are new ones. */
    whenMade(listener: () => void): void {
        this.listeners.push(listener);
        listener();
    }

    /** Draws anew, with the axes as they are now. */
    redraw(): void {
        const { x, y, logY } = this.range();
        if (logY !== this.logY) {
            // uPlot fixes the kind of a scale when it is made.
            this.logY = logY;
            this.plot.destroy();
            this.plot = this.create();
            this.listeners.forEach((listener) => listener());
            return;
        }
        this.plot.batch(() => {
            this.plot.setScale("x", { min: x[0], max: x[1] });
            this.plot.setScale("y", { min: y[0], max: y[1] });
        });
        this.plot.redraw(false, true);
    }

    /** Canvas pixels per CSS pixel. */
    get density(): number {
        return uPlot.pxRatio;
    }

    /** From values to canvas pixels. */
    readonly toX = (value: number): number => this.plot.valToPos(value, "x", true);
    readonly toY = (value: number): number => this.plot.valToPos(value, "y", true);

    range(): Range {
        const range = this.options.range();
        const { x, y } = range;
        const widen = ([low, high]: [number, number]): [number, number] => {
            const size = Math.max(Math.abs(low), Math.abs(high));
            const margin = 1e-3 * size || 1;
            return high - low > NARROWEST * size ? [low, high] : [low - margin, high + margin];
        };
        return { ...range, x: widen(x), y: widen(y) };
    }

    /** Remembers the ticks of an axis. */
    private keep(axis: "x" | "y", splits: readonly number[], labels: readonly string[]): string[] {
        const all = splits.map((value, k): [number, string] => [value, labels[k] ?? ""]);
        this.ticks[axis] = {
            labelled: all.filter(([, label]) => label !== ""),
            minor: all.filter(([, label]) => label === "").map(([value]) => value),
        };
        return [...labels];
    }

    private create(): uPlot {
        return new uPlot(
            this.plotOptions(),
            [
                [0, 1],
                [null, null],
            ],
            this.host,
        );
    }

    private resize(): void {
        const size = this.size();
        if (size.width !== this.plot.width || size.height !== this.plot.height) {
            this.plot.setSize(size);
            // Ends of axes may depend on the size: a circle stays one.
            this.redraw();
        }
    }

    private size(): { width: number; height: number } {
        const width = Math.max(200, Math.floor(this.host.clientWidth));
        return { width, height: this.options.height() };
    }

    private plotOptions(): uPlot.Options {
        const { x, y, logY } = this.range();
        const ink = (): string => this.theme.look.ink;
        const grid = { stroke: () => this.theme.look.grid, width: 1 };
        const common = { stroke: ink, font: FONT, labelFont: LABEL_FONT, grid, ticks: { ...grid, size: 4 } };
        return {
            ...this.size(),
            ms: 1e-3,
            pxAlign: false,
            padding: [8, () => Math.max(RIGHT, 0.5 * CHARACTER * this.lastLabel), 0, 0],
            legend: { show: false },
            cursor: { show: false },
            scales: {
                x: { time: false, auto: false, min: x[0], max: x[1] },
                y: { auto: false, min: y[0], max: y[1], ...(logY ? { distr: 3 as const } : {}) },
            },
            series: [{}, { show: true, paths: () => null, points: { show: false } }],
            axes: [
                {
                    ...common,
                    label: (plot: uPlot, _: number, distance: number) =>
                        (this.label.x = less(this.options.xLabel(), commonOf(plot, "x", distance))),
                    labelSize: 20,
                    size: 30,
                    space: this.options.space ?? WIDE,
                    values: (plot, splits, __, ___, distance) => {
                        const labels = ticks(splits, distance, commonOf(plot, "x", distance));
                        this.lastLabel = labels.at(-1)?.length ?? 0;
                        return this.keep("x", splits, labels);
                    },
                },
                {
                    ...common,
                    label: (plot: uPlot, _: number, distance: number) =>
                        (this.label.y = less(
                            this.options.yLabel(),
                            logY ? logarithmic(plot).common : commonOf(plot, "y", distance),
                        )),
                    labelSize: 20,
                    size: (_, labels) =>
                        Math.max(
                            NARROW,
                            12 + CHARACTER * Math.max(0, ...(labels ?? []).map((label) => label.length)),
                        ),
                    space: TALL,
                    ...(logY
                        ? {
                              splits: (plot: uPlot) => this.labelled(plot),
                              filter: (_: uPlot, splits: number[]) => splits,
                          }
                        : {}),
                    values: (plot, splits, __, ___, distance) =>
                        logY
                            ? this.ticks.y.labelled.map(([, label]) => label)
                            : this.keep("y", splits, ticks(splits, distance, commonOf(plot, "y", distance))),
                },
            ],
            hooks: { draw: [(plot) => this.paint(plot)] },
        };
    }

    /** The ticks of a logarithmic axis that have a label, and with it a line of the grid. */
    private labelled(plot: uPlot): number[] {
        const { splits, labels } = logarithmic(plot);
        this.keep("y", splits, labels);
        return this.ticks.y.labelled.map(([value]) => value);
    }

    /** Ticks without labels: short lines at the edge. */
    private paintMinor(context: CanvasRenderingContext2D): void {
        const { left } = this.plot.bbox;
        context.strokeStyle = this.theme.look.pale;
        context.lineWidth = this.density;
        context.beginPath();
        for (const value of this.ticks.y.minor) {
            context.moveTo(left, this.toY(value));
            context.lineTo(left + 4 * this.density, this.toY(value));
        }
        context.stroke();
    }

    /** The state of the context is left as it was: uPlot remembers what it has set. */
    private paint(plot: uPlot): void {
        const { ctx: context, bbox } = plot;
        context.save();
        context.beginPath();
        context.rect(bbox.left, bbox.top, bbox.width, bbox.height);
        context.save();
        context.clip();
        this.paintMinor(context);
        this.options.paint(context, this);
        context.restore();
        context.strokeStyle = this.theme.look.pale;
        context.lineWidth = this.density;
        context.setLineDash([]);
        context.strokeRect(bbox.left, bbox.top, bbox.width, bbox.height);
        context.restore();
    }
}
