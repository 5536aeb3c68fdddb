// What the page shows at a moment, and who wants to know when it changes.

import type { Axis } from "./units";

export interface View {
    /** Values at the ends, in the unit of the axis. */
    x: [number, number];
    /** Values at the ends, in the unit of the axis. */
    y: [number, number];
}

/** What lies over the branches: measured points by their kind, motions that do not repeat. */
export const DOTS = ["periodic", "aperiodic", "unknown", "irregular"] as const;
export type DotLayer = (typeof DOTS)[number];

/**
 * What has a switch in the legend besides the periods: what lies over or behind the branches, kinds of
 * lines, kinds of marks.
 */
export const LAYERS = [
    ...DOTS,
    "chaos",
    "stable",
    "marginal",
    "unstable",
    "fold",
    "fold-at-grazing",
    "flip",
    "neimark-sacker",
    "branch-point",
    "of-unstable",
    "grazing",
] as const;
export type Layer = (typeof LAYERS)[number];

export interface State {
    /** What the vertical axis shows. */
    quantity: Axis;
    /** What the horizontal axis shows. */
    across: Axis;
    /** The parameter of the branches that are shown: 0 for the frequency. */
    over: number;
    log: boolean;
    /** What of the diagram is seen; null for all of it. */
    view: View | null;
    /** Number of the selected solution; -1 for none. */
    selected: number;
    /** Places of the branches that are not drawn, all those over another parameter among them. */
    hidden: ReadonlySet<number>;
    theme: "auto" | "light" | "dark";
    marks: boolean;
    /** Whether special points have their numbers beside them. */
    numbers: boolean;
    /** Layers that are not drawn. */
    off: ReadonlySet<Layer>;
    /** Whether measured points stand where the comparison has shifted them. */
    shifted: boolean;
    /** Section that is shown. */
    section: number;
}

export type Key = keyof State;
type Listener = (state: State, changed: ReadonlySet<Key>) => void;

export class Store {
    private readonly listeners: Listener[] = [];

    constructor(public state: State) {}

    listen(listener: Listener): void {
        this.listeners.push(listener);
    }

    update(change: Partial<State>): void {
        const keys = (Object.keys(change) as Key[]).filter((key) => change[key] !== this.state[key]);
        if (keys.length > 0) {
            this.state = { ...this.state, ...change };
            const changed = new Set(keys);
            this.listeners.forEach((listener) => listener(this.state, changed));
        }
    }
}

export const START: State = {
    quantity: "displacement",
    across: "parameter",
    over: 0,
    log: true,
    view: null,
    selected: -1,
    hidden: new Set(),
    theme: "auto",
    marks: true,
    numbers: false,
    off: new Set(),
    shifted: true,
    section: 0,
};
