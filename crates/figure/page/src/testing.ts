// What tests and benchmarks see of the page.

import { saved } from "./export";
import type { LegendOf } from "./legend";
import type { Multiplier } from "./multiplier_table";
import type { Orbit } from "./orbit";
import type { Others } from "./others";
import type { Response } from "./response";
import { marksOf } from "./response_paint";
import type { SolutionView } from "./solution_view";
import type { State, Store } from "./state";

declare global {
    interface Window {
        hammerbeam: {
            redraw: () => void;
            zoom: (factor: number) => void;
            pan: (across: number, up: number) => void;
            placeOf: (solution: number) => [number, number];
            pointAt: (across: number, value: number) => [number, number];
            state: () => State;
            orbit: () => Orbit | null;
            unitCircle: () => [across: number, up: number];
            multipliersOf: (solution: number) => Multiplier[];
            saved: (ending: "svg" | "png" | "csv") => Promise<string>;
            compare: (name: string, text: string) => Promise<void>;
            marks: () => { layer: string; solution: number; at: [number, number]; room: number }[];
            labels: () => { x: string[]; y: string[]; titles: [string, string]; minor: number };
        };
    }
}

export function forTests({
    response,
    store,
    view,
    others,
    of,
}: {
    response: Response;
    store: Store;
    view: SolutionView;
    others: Others;
    of: LegendOf;
}): void {
    window.hammerbeam = {
        redraw: () => response.redraw(),
        zoom: (factor) => response.zoom([factor, factor]),
        pan: (across, up) => response.pan([across, up]),
        placeOf: (solution) => response.placeOf(solution),
        pointAt: (across, value) => response.pointAt(across, value),
        state: () => store.state,
        orbit: () => view.orbit,
        unitCircle: () => view.unitCircle(),
        multipliersOf: (solution) => view.multipliersOf(solution),
        saved: async (ending) => {
            const blob = await saved(response.frame, response.scene(), ending, of);
            return ending === "png" ? `${blob.type} ${blob.size}` : blob.text();
        },
        compare: (name, text) => others.open([{ name, text: () => Promise.resolve(text) }]),
        marks: () =>
            marksOf(response.frame, response.scene()).map(({ mark, solution, at }) => ({
                layer: mark.layer,
                solution,
                at,
                room: mark.room * response.frame.density,
            })),
        labels: () => {
            const { ticks, label } = response.frame;
            return {
                x: ticks.x.labelled.map(([, text]) => text),
                y: ticks.y.labelled.map(([, text]) => text),
                titles: [label.x, label.y],
                minor: ticks.y.minor.length,
            };
        },
    };
}
