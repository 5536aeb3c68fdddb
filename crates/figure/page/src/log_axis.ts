// Ticks of a logarithmic axis: at 1 to 9 times powers of ten, labelled where there is room; where fewer than
// three of them are seen, at equal distances.

import { commonPart, logTicks, ticks } from "./format";

export interface LogAxis {
    splits: number[];
    labels: string[];
    /** What the labels leave out. */
    common: number;
}

/** Ticks between two positive values with room for so many labels. */
export function logAxis(low: number, high: number, room: number): LogAxis {
    const decades = Math.log10(high / low);
    const splits: number[] = [];
    const [first, last] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
    const every = Math.max(1, Math.ceil(decades / Math.max(1, room)));
    for (let exponent = first; exponent <= last; exponent++) {
        for (let mantissa = 1; mantissa <= (every === 1 ? 9 : 1); mantissa++) {
            const value = Number(`${mantissa}e${exponent}`);
            if (value >= low && value <= high) {
                splits.push(value);
            }
        }
    }
    if (splits.length < 3) {
        return evenly(low, high, room);
    }
    const perDecade = room / decades;
    const isLabelled = (value: number, mantissas: string): boolean => {
        const [mantissa = "", exponent = ""] = value.toExponential(0).split("e");
        return mantissas.includes(mantissa) && Number(exponent) % every === 0;
    };
    const few = perDecade >= 2.5 ? "125" : "1";
    // A label at every tick only where there are hardly any others.
    const mantissas =
        perDecade >= 9 && splits.filter((value) => isLabelled(value, few)).length < 3 ? "123456789" : few;
    const labels = logTicks(splits.map((value) => (isLabelled(value, mantissas) ? value : null)));
    return { splits, labels, common: 0 };
}

/** Ticks at 1, 2 or 5 times a power of ten from each other. */
function evenly(low: number, high: number, room: number): LogAxis {
    const least = (high - low) / Math.max(1, room);
    const power = 10 ** Math.floor(Math.log10(least));
    const distance = [1, 2, 5, 10].map((step) => step * power).find((step) => step >= least) ?? 10 * power;
    const splits: number[] = [];
    for (let k = Math.ceil(low / distance); k * distance <= high && splits.length < 50; k++) {
        splits.push(k * distance);
    }
    const common = commonPart(low, high, distance);
    return { splits, labels: ticks(splits, distance, common), common };
}
