// What the page shows at a moment, and who wants to know when it changes.

import type { Quantity } from "./data";

export interface View {
    /** Frequencies at the ends (Hz). */
    x: [number, number];
    /** Values at the ends, in the unit of the axis. */
    y: [number, number];
}

/** What lies over or behind the branches and has a switch in the legend: measured points by their kind, motions that do not repeat, chaotic ranges. */
export const LAYERS = ["periodic", "aperiodic", "unknown", "irregular", "chaos"] as const;
export type Layer = (typeof LAYERS)[number];

export interface State {
    quantity: Quantity;
    log: boolean;
    /** What of the diagram is seen; null for all of it. */
    view: View | null;
    /** Number of the selected solution; -1 for none. */
    selected: number;
    /** Places of the branches that are not drawn. */
    hidden: ReadonlySet<number>;
    theme: "auto" | "light" | "dark";
    marks: boolean;
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
    log: true,
    view: null,
    selected: -1,
    hidden: new Set(),
    theme: "auto",
    marks: true,
    off: new Set(),
    shifted: true,
    section: 0,
};
