// What lies over the branches: measured points, and the largest displacements of motions that do not repeat.

import { isOverFrequency } from "./chaos";
import type { Measured, MeasuredPoint, Meta, Motion } from "./data";
import { digits, hertz, periodName, shortHertz } from "./format";
import type { DotLayer, State } from "./state";
import { MEASURES, measureOf } from "./units";

/** A point over the branches. */
export interface Dot {
    layer: DotLayer;
    /** Hz. */
    frequency: number;
    /** Place on both axes, in their units. */
    x: number;
    value: number;
    of: { series: Measured; point: MeasuredPoint } | { motion: Motion };
}

/** The points that are drawn. */
export function dotsOf(meta: Meta, state: State): Dot[] {
    const { quantity, shifted, off } = state;
    if (!isOverFrequency(state) || quantity === "parameter") {
        return [];
    }
    const { factor } = measureOf(meta, quantity, 0);
    const dots: Dot[] = [];
    const add = (
        layer: Dot["layer"],
        [frequency, value]: readonly [number | null, number | null],
        of: Dot["of"],
    ): void => {
        if (frequency !== null && value !== null && !off.has(layer)) {
            dots.push({
                layer,
                frequency,
                x: MEASURES.frequency.factor * frequency,
                value: factor * value,
                of,
            });
        }
    };
    if (quantity === "displacement") {
        meta.motions.forEach((motion) =>
            add("irregular", [motion.frequency, motion.displacement], { motion }),
        );
    }
    for (const series of meta.measured.filter((one) => one.quantity === quantity)) {
        series.points.forEach((point) =>
            add(point.motion, shifted ? point.shifted : point.measured, { series, point }),
        );
    }
    return dots;
}

/** The numbers of a point in words. */
export function dotText(meta: Meta, dot: Dot, { quantity }: State): [string, string][] {
    const { factor, unit, name } = measureOf(meta, quantity, 0);
    if ("motion" in dot.of) {
        return [
            ["Motion of a sweep", dot.of.motion.kind],
            ["Frequency", hertz(dot.frequency)],
            [`Max. ${name}`, `${digits(dot.value, 6)} ${unit}`],
        ];
    }
    const { series, point } = dot.of;
    const place = ([frequency, value]: readonly [number | null, number | null]): string =>
        `${digits(factor * (value ?? NaN), 5)} ${unit} at ${shortHertz(frequency ?? NaN, 7)}`;
    const kind = point.motion === "unknown" ? "kind unknown" : point.motion;
    return [
        ["Measured", `${kind}${point.period === null ? "" : `, ${periodName(point.period)}`}`],
        ["As measured", place(point.measured)],
        ["Shifted", place(point.shifted)],
        ["Compared", point.verdict.replaceAll("-", " ")],
        ["From", `${series.name}: ${point.origin.replace("__line_", ", line ")}`],
    ];
}
