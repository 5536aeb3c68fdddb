// A frame with lines of an orbit in it, and a pointer that shows the instant of the animation.

import { element } from "./dom";
import { Frame, type Range } from "./frame";
import type { Theme } from "./theme";

export interface Line {
    x: ArrayLike<number>;
    y: ArrayLike<number>;
    colour: string;
    dash?: number[];
}

export interface Plot {
    xLabel: string;
    yLabel: string;
    range: Range;
    lines: Line[];
    /** Places that are marked by circles. */
    circles?: [number, number][];
    /** Frequencies that are marked by lines from bottom to top. */
    verticals?: number[];
    /** Level from which a line stands to each point instead. */
    stems?: number;
}

/** Ends of an axis that holds all finite values, widened a little. */
export function ends(series: readonly ArrayLike<number>[]): [number, number] {
    let [low, high] = [Infinity, -Infinity];
    for (const values of series) {
        for (let k = 0; k < values.length; k++) {
            const value = values[k] ?? NaN;
            if (Number.isFinite(value)) {
                low = Math.min(low, value);
                high = Math.max(high, value);
            }
        }
    }
    if (low > high) {
        return [0, 1];
    }
    const margin = 0.06 * (high - low) || 0.1 * Math.abs(high) || 1;
    return [low - margin, high + margin];
}

const NOTHING: Plot = { xLabel: "", yLabel: "", range: { x: [0, 1], y: [0, 1], logY: false }, lines: [] };

export class LinePlot {
    readonly host = element("div", { class: "plot" });
    private plot: Plot = NOTHING;
    private frame: Frame | null = null;
    private readonly pointer: HTMLElement;

    constructor(
        private readonly theme: Theme,
        private readonly height: number,
        private readonly pointed: "instant" | "place" | "nothing" = "instant",
    ) {
        this.pointer = element("div", { class: pointed });
    }

    show(plot: Plot): void {
        this.plot = plot;
        if (this.frame === null) {
            this.frame = new Frame(
                this.host,
                {
                    xLabel: () => this.plot.xLabel,
                    yLabel: () => this.plot.yLabel,
                    range: () => this.plot.range,
                    paint: (context, frame) => this.paint(context, frame),
                    height: () => this.height,
                },
                this.theme,
            );
            const { frame } = this;
            frame.whenMade(() => frame.plot.over.append(this.pointer));
        } else {
            this.frame.redraw();
        }
    }

    /** Moves the pointer to a value; in a plane to a place. */
    point(x: number, y = 0): void {
        const plot = this.frame?.plot;
        if (plot !== undefined && this.pointed !== "nothing") {
            const down = this.pointed === "place" ? plot.valToPos(y, "y") : 0;
            this.pointer.style.transform = `translate(${plot.valToPos(x, "x")}px, ${down}px)`;
        }
    }

    private paint(context: CanvasRenderingContext2D, frame: Frame): void {
        const density = frame.density;
        const { top, height } = frame.plot.bbox;
        context.lineJoin = "round";
        context.setLineDash([3 * density, 3 * density]);
        context.lineWidth = density;
        context.strokeStyle = this.theme.look.pale;
        context.beginPath();
        for (const x of this.plot.verticals ?? []) {
            context.moveTo(frame.toX(x), top);
            context.lineTo(frame.toX(x), top + height);
        }
        context.stroke();
        context.lineWidth = 1.5 * density;
        const { stems } = this.plot;
        const foot = stems === undefined ? 0 : Math.min(top + height, Math.max(top, frame.toY(stems)));
        for (const line of this.plot.lines) {
            context.strokeStyle = line.colour;
            context.setLineDash((line.dash ?? []).map((length) => length * density));
            context.beginPath();
            let isDown = false;
            for (let k = 0; k < line.x.length; k++) {
                const [x, y] = [frame.toX(line.x[k] ?? NaN), frame.toY(line.y[k] ?? NaN)];
                if (stems !== undefined) {
                    context.moveTo(x, foot);
                    context.lineTo(x, y);
                } else if (!Number.isFinite(x) || !Number.isFinite(y)) {
                    isDown = false;
                } else if (isDown) {
                    context.lineTo(x, y);
                } else {
                    context.moveTo(x, y);
                    isDown = true;
                }
            }
            context.stroke();
        }
        context.setLineDash([]);
        context.strokeStyle = this.theme.look.ink;
        context.fillStyle = this.theme.look.paper;
        for (const [x, y] of this.plot.circles ?? []) {
            context.beginPath();
            context.arc(frame.toX(x), frame.toY(y), 3.5 * density, 0, 2 * Math.PI);
            context.fill();
            context.stroke();
        }
    }
}
