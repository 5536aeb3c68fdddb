// The state as the part of the address after #, so that a link leads back to it.

import type { Meta, Solutions } from "./data";
import { LAYERS, START, type State } from "./state";
import type { Axis } from "./units";

/** Shortest decimal that is good to a hundred millionth of the width of the view. */
function short(value: number, width: number): string {
    const digits = Math.min(15, Math.max(0, Math.ceil(8 - Math.log10(Math.abs(width) || 1))));
    return Number(value.toFixed(digits)).toString();
}

export function toHash(state: State, meta: Meta, solutions: Solutions): string {
    const parts: string[] = [];
    if (state.quantity !== START.quantity) {
        parts.push(`show=${state.quantity}`);
    }
    if (state.across !== START.across) {
        parts.push(`over=${state.across}`);
    }
    if (state.over !== START.over) {
        parts.push(`parameter=${state.over}`);
    }
    parts.push(`scale=${state.log ? "log" : "linear"}`);
    if (state.view !== null) {
        const { x, y } = state.view;
        parts.push(`x=${x.map((value) => short(value, x[1] - x[0])).join(",")}`);
        parts.push(`y=${y.map((value) => short(value, state.log ? y[0] : y[1] - y[0])).join(",")}`);
    }
    if (state.selected >= 0) {
        const branch = meta.branches[solutions.branch[state.selected] ?? 0];
        parts.push(`at=${branch?.id ?? 0}:${state.selected - (branch?.first ?? 0)}`);
    } else {
        parts.push("at=none");
    }
    const left = [...state.hidden].filter((place) => meta.branches[place]?.over === state.over);
    if (left.length > 0) {
        const ids = left.map((place) => meta.branches[place]?.id ?? 0);
        parts.push(`hide=${ids.sort((a, b) => a - b).join(",")}`);
    }
    if (state.theme !== "auto") {
        parts.push(`theme=${state.theme}`);
    }
    if (!state.marks) {
        parts.push("marks=off");
    }
    if (state.numbers) {
        parts.push("numbers=on");
    }
    if (state.off.size > 0) {
        parts.push(`off=${LAYERS.filter((layer) => state.off.has(layer)).join(",")}`);
    }
    if (!state.shifted) {
        parts.push("shifted=no");
    }
    if (state.section !== 0) {
        parts.push(`section=${state.section + 1}`);
    }
    return `#${parts.join("&")}`;
}

/** Two finite numbers in order, or null. */
function pair(text: string | null): [number, number] | null {
    const [low, high] = (text ?? "").split(",").map(Number);
    return low !== undefined && high !== undefined && Number.isFinite(low) && high > low ? [low, high] : null;
}

/** What a link leaves open. */
export interface Openings {
    /** Axes of which there is something. */
    quantities: readonly Axis[];
    /** Whether a logarithmic axis suits what it shows. */
    suits: (quantity: Axis, over: number) => boolean;
    /** The solution that is selected where a link names none. */
    first: number;
}

/** The state of a link; what is not there, or makes no sense, is as at the start. */
export function fromHash(hash: string, meta: Meta, { quantities, suits, first }: Openings): State {
    const words = new URLSearchParams(hash.replace(/^#/, ""));
    const [x, y] = [pair(words.get("x")), pair(words.get("y"))];
    const at = words.get("at");
    const [id, number] = (at ?? "").split(":").map(Number);
    const branch = meta.branches.find((one) => one.id === id);
    const inside = branch !== undefined && number !== undefined && number >= 0 && number < branch.count;
    const off = (words.get("off") ?? "").split(",");
    const theme = words.get("theme");
    const section = Number(words.get("section") ?? 1) - 1;
    const scale = words.get("scale");
    const quantity = quantities.find((one) => one === words.get("show")) ?? START.quantity;
    const over =
        meta.parameters[Number(words.get("parameter") ?? 0) - 1] === undefined
            ? 0
            : Number(words.get("parameter"));
    const ids = (words.get("hide") ?? "").split(",").map(Number);
    const hidden = meta.branches.map((one, place) =>
        one.over !== over || ids.includes(one.id) ? place : -1,
    );
    return {
        quantity,
        across: quantities.find((one) => one === words.get("over")) ?? START.across,
        over,
        log: scale === null ? suits(quantity, over) : scale === "log",
        view: x !== null && y !== null ? { x, y } : null,
        selected: inside ? branch.first + Math.trunc(number) : at === null && over === 0 ? first : -1,
        hidden: new Set(hidden.filter((place) => place >= 0)),
        theme: theme === "light" || theme === "dark" ? theme : "auto",
        marks: words.get("marks") !== "off",
        numbers: words.get("numbers") === "on",
        off: new Set(LAYERS.filter((layer) => off.includes(layer))),
        shifted: words.get("shifted") !== "no",
        section: section >= 0 && section < meta.sections.length ? Math.trunc(section) : 0,
    };
}
