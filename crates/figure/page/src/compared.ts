// Other results over the branches: pages or tables of branches that the reader opens beside this one.

import { Curves, type Scales } from "./curves";
import {
    BRANCH_POINT,
    FLIP,
    FOLD,
    GRAZING,
    MARGINAL,
    NEIMARK_SACKER,
    readSolutions,
    STABLE,
    type Branch,
    type Meta,
    type Solutions,
} from "./data";
import type { Frame } from "./frame";
import { linesOf, type Lines } from "./paths";
import type { Scene } from "./response_paint";
import type { Theme } from "./theme";
import { inflated } from "./unpack";

export interface Compared {
    name: string;
    meta: Meta;
    curves: Curves;
    isDrawn: boolean;
}

/** Colour of the results with a place in the list of those that were opened. */
export function comparedColour(theme: Theme, place: number): string {
    return [theme.look.pale, theme.period(8), theme.period(4), theme.period(6)][place % 4] ?? theme.look.pale;
}

/** Reads a page, or a table of branches; throws with what is wrong. */
export async function readCompared(name: string, text: string, own: Meta): Promise<Compared> {
    const { meta, solutions } = text.trimStart().startsWith("<")
        ? await readPage(text)
        : readTable(text, own);
    return {
        name: meta.title === own.title || meta.title === "" ? name : `${meta.title} (${name})`,
        meta,
        curves: new Curves(meta, solutions),
        isDrawn: true,
    };
}

async function readPage(text: string): Promise<{ meta: Meta; solutions: Solutions }> {
    const page = new DOMParser().parseFromString(text, "text/html");
    const part = (id: string): string => page.getElementById(id)?.textContent ?? "";
    const meta = JSON.parse(part("meta") || "null") as Meta | null;
    if (meta === null || !Array.isArray(meta.parameters) || !Array.isArray(meta.outputs)) {
        throw new Error("it is no page of this version of Hammerbeam; draw it anew with hammerbeam figure");
    }
    const solutions = readSolutions(meta, await inflated(part("solutions")));
    // Those over another parameter come last, and have no place here.
    return { meta: { ...meta, branches: meta.branches.filter(({ over }) => over === 0) }, solutions };
}

const EVENTS: readonly (readonly [string, number])[] = [
    ["fold", FOLD],
    ["flip", FLIP],
    ["neimark-sacker", NEIMARK_SACKER],
    ["branch-point", BRANCH_POINT],
    ["grazing", GRAZING],
];

/** Reads branches.csv of an export. */
function readTable(text: string, own: Meta): { meta: Meta; solutions: Solutions } {
    const [head = "", ...lines] = text.trim().split(/\r?\n/);
    const titles = head.split(",");
    for (const title of ["branch", "period_multiple", "frequency_hz"]) {
        if (!titles.includes(title)) {
            throw new Error(`it is neither a page nor a table of branches: there is no column ${title}`);
        }
    }
    const rows = lines.map((line) => line.split(","));
    const words = (title: string): string[] => rows.map((row) => row[titles.indexOf(title)] ?? "");
    const numbers = (title: string): number[] =>
        words(title).map((word) => (word === "" ? NaN : Number(word)));
    const [ids, periods] = [numbers("branch"), numbers("period_multiple")];
    const branches: Branch[] = [];
    ids.forEach((id, k) => {
        const last = branches.at(-1);
        if (last === undefined || last.id !== id) {
            branches.push({ id, period: periods[k] ?? 1, ends: ["", ""], first: k, count: 1, over: 0 });
        } else {
            last.count++;
        }
    });
    const [stable, events] = [words("stable"), words("event")];
    const flags = Uint32Array.from(stable, (word, k) => {
        const known = new Set((events[k] ?? "").split("+"));
        const bits = EVENTS.reduce((sum, [event, bit]) => sum | (known.has(event) ? bit : 0), 0);
        return bits | (word === "false" || word === "0" ? 0 : STABLE) | (word === "marginal" ? MARGINAL : 0);
    });
    const single = (title: string): Float32Array => Float32Array.from(numbers(title));
    const frequency = Float64Array.from(numbers("frequency_hz"));
    const branch = new Uint16Array(rows.length);
    branches.forEach(({ first, count }, place) => branch.fill(place, first, first + count));
    const solutions: Solutions = {
        count: rows.length,
        frequency,
        parameter: frequency,
        maxima: {
            displacement: single("max_abs_displacement_m"),
            acceleration: single("max_abs_acceleration_m_s2"),
            force: single("max_contact_force_n"),
            velocity: single("max_impact_velocity_m_s"),
        },
        multiplierRe: single("leading_multiplier_re"),
        multiplierIm: single("leading_multiplier_im"),
        energy: single("energy_j"),
        contacts: Uint32Array.from(numbers("contacts")),
        outputs: [],
        flags,
        branch,
    };
    return { meta: { ...own, title: "", branches, parameters: [], outputs: [] }, solutions };
}

/**
 * Thin lines behind the branches, solid where solutions are stable; nothing where the diagram is over
 * another parameter than the frequency.
 */
export function paintCompared(
    context: CanvasRenderingContext2D,
    frame: Frame,
    { compared, state, theme }: Scene,
    scales: Scales,
): void {
    if (state.over !== 0) {
        return;
    }
    const density = frame.density;
    compared.forEach(({ meta, curves, isDrawn }, place) => {
        if (!isDrawn) {
            return;
        }
        const [across, levels] = [curves.across(state), curves.levels(state)];
        context.strokeStyle = comparedColour(theme, place);
        for (const { first, count } of meta.branches) {
            const lines: Lines = linesOf(curves.solutions, { across, levels, first, count }, scales, {
                count: 0,
                spacing: 1,
                apart: 1,
                reach: 0,
            });
            for (const [look, width, dash] of [
                ["unstable", 1, [2, 4]],
                ["marginal", 1.6, [2, 3]],
                ["stable", 1.6, []],
            ] as const) {
                context.lineWidth = width * density;
                context.setLineDash(dash.map((length) => length * density));
                context.stroke(lines[look] as Path2D);
            }
        }
    });
    context.setLineDash([]);
}
