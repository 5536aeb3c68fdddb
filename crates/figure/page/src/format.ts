// Numbers as they are read: a point, thin digits, units.

import { MEASURES } from "./units";

/** So many significant digits; powers of ten for what is very small or very large. */
export function digits(value: number, count: number): string {
    if (!Number.isFinite(value)) {
        return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "−∞";
    }
    const size = Math.abs(value);
    if (size === 0) {
        return "0";
    }
    const text =
        size < 1e-3 || size >= 1e6
            ? value.toExponential(count - 1)
            : size >= 10 ** count
              ? value.toFixed(0)
              : value.toPrecision(count);
    return text.replace("e+", "e").replaceAll("-", "−");
}

/** Digits of a label up to which it is written in full. */
const LONGEST = 7;

/**
 * What the labels of an axis have in common, where they would have too many digits to stand beside each
 * other; 0 where they have not.
 *
 * It has no more digits than it needs to leave short labels: its last one is that of the width of the axis.
 *
 * * `low`, `high`: the ends of the axis; `distance`: of its ticks.
 */
export function commonPart(low: number, high: number, distance: number): number {
    const largest = Math.max(Math.abs(low), Math.abs(high));
    const digitsOf = Math.floor(Math.log10(largest)) - Math.floor(Math.log10(distance) + 1e-9) + 1;
    if (!(digitsOf > LONGEST)) {
        return 0;
    }
    const last = Math.ceil(Math.log10(high - low));
    const nearer = low < 0 ? high : low;
    return last >= 0
        ? Math.trunc(nearer / 10 ** last) * 10 ** last
        : Number((Math.trunc(nearer * 10 ** -last) / 10 ** -last).toFixed(Math.min(20, -last)));
}

/**
 * Labels of ticks at a distance, all of them with the digits that tell neighbours apart; powers of ten where
 * they are very small or very large.
 *
 * * `common`: what they leave out.
 */
export function ticks(marked: readonly (number | null)[], distance: number, common = 0): string[] {
    const splits = marked.map((value) => (value === null ? null : value - common));
    const largest = splits.reduce<number>((most, value) => Math.max(most, Math.abs(value ?? 0)), 0);
    // The last digit of the distance, which uPlot takes from 1, 2, 2.5 and 5 times a power of ten.
    let last = Math.floor(Math.log10(distance) + 1e-9);
    last -= Math.abs(distance / 10 ** last - Math.round(distance / 10 ** last)) > 1e-6 ? 1 : 0;
    const plain = (value: number): string => {
        if (Math.abs(value) < 0.5 * distance) {
            return "0";
        }
        const size = Math.floor(Math.log10(Math.abs(value)) + 1e-12);
        const text =
            largest >= 1e6 || largest < 1e-3
                ? value.toExponential(Math.min(15, Math.max(0, size - last))).replace("e+", "e")
                : value.toFixed(Math.min(15, Math.max(0, -last)));
        return text.replaceAll("-", "−");
    };
    return splits.map((value) => (value === null ? "" : plain(value)));
}

/** Labels of the ticks of a logarithmic axis: all of them as powers of ten where one of them is better so. */
export function logTicks(splits: readonly (number | null)[]): string[] {
    const asPowers = splits.some((value) => value !== null && (value >= 1e5 || value < 1e-3));
    return splits.map((value) => {
        if (value === null) {
            return "";
        }
        return asPowers
            ? value.toExponential(0).replace("e+", "e").replaceAll("-", "−")
            : String(Number(value.toPrecision(3)));
    });
}

/** A frequency in the unit of this page. */
export function hertz(value: number): string {
    const { factor, unit } = MEASURES.frequency;
    const decimals = Math.min(12, 6 + Math.max(0, Math.round(-Math.log10(factor))));
    return `${(factor * value).toFixed(decimals)} ${unit}`;
}

/** A frequency with so many digits, in the unit of this page. */
export function shortHertz(value: number, count: number): string {
    const { factor, unit } = MEASURES.frequency;
    return `${digits(factor * value, count)} ${unit}`;
}

/** A real number, or a complex pair. */
export function complex(re: number, im: number): string {
    if (im === 0) {
        return digits(re, 4);
    }
    return `${digits(re, 4)} ± ${digits(Math.abs(im), 4)}i`;
}

/** Solutions of a period multiple in words, as printed figures have them. */
export function periodName(period: number): string {
    return period <= 1 ? "harmonic" : `1/${period} subharmonic`;
}
