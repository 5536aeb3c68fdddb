// Masses in motion along a line, with what joins them and what they hit, on a canvas. Positive displacements go to the right.

import type { Stop, Structure } from "./data";
import type { Pose } from "./motion";
import { dashpot, hatched, spring, type Sketch } from "./sketch";

const SIZE = 44;
const WALL = 14;
/** Room of the walls to move in. */
const EDGE = 16;

export interface Rows {
    /** Where each mass rests (CSS pixels from the left). */
    rest: number[];
    /** The largest displacement that keeps masses apart (CSS pixels). */
    room: number;
}

export function rowsOf(structure: Structure, width: number): Rows {
    const count = structure.places.length;
    const spacing = (width - 2 * (WALL + EDGE)) / (count + 1);
    return { rest: structure.places.map((_, k) => WALL + EDGE + (k + 1) * spacing), room: Math.max(6, 0.4 * (spacing - SIZE)) };
}

export function drawMasses(sketch: Sketch, structure: Structure, pose: Pose, perMetre: number): void {
    const { context, width, height, theme } = sketch;
    const { rest } = rowsOf(structure, width);
    const middle = height / 2;
    const x = (place: number): number => (rest[place] ?? 0) + perMetre * (pose.places[place] ?? 0);
    const ground = Math.max(-EDGE, Math.min(EDGE, perMetre * pose.support));
    const last = structure.places.length - 1;
    hatched(sketch, [EDGE + ground, middle - 60, WALL, 120], theme.look.ink);
    if (structure.links.some(({ ends }) => ends.includes(null) && ends.includes(last) && last > 0)) {
        hatched(sketch, [width - WALL - EDGE + ground, middle - 60, WALL, 120], theme.look.ink);
    }
    context.lineWidth = 1.4;
    context.strokeStyle = theme.look.ink;
    const seen = new Map<string, number>();
    for (const { ends, damper } of structure.links) {
        const join = damper ? dashpot : spring;
        const [a, b] = [...ends].sort((one, other) => (one ?? -1) - (other ?? -1));
        const key = `${a} ${b}`;
        const level = seen.get(key) ?? 0;
        seen.set(key, level + 1);
        const right = b ?? 0;
        if (a === null && right === last && last > 0) {
            join(sketch, x(right) + SIZE / 2, width - WALL - EDGE + ground, middle - 10 + 16 * level);
        } else {
            const isFar = right - (a ?? -1) > 1;
            const from = a === null || a === undefined ? WALL + EDGE + ground : x(a) + SIZE / 2;
            join(sketch, from, x(right) - SIZE / 2, isFar ? middle + 46 + 14 * level : middle - 10 + 16 * level);
        }
    }
    for (const stop of structure.stops) {
        drawStop(sketch, stop, pose, perMetre, rest, middle);
    }
    structure.places.forEach((place, k) => {
        context.fillStyle = theme.period(1);
        context.fillRect(x(k) - SIZE / 2, middle - SIZE / 2, SIZE, SIZE);
        context.fillStyle = theme.look.ink;
        context.font = "12px system-ui, sans-serif";
        context.textAlign = "center";
        context.fillText(place.name, rest[k] ?? 0, middle - SIZE / 2 - 16);
    });
}

/** A plate at each level; one that sits on another mass is joined to it. */
function drawStop({ context, theme }: Sketch, stop: Stop, pose: Pose, perMetre: number, rest: number[], middle: number): void {
    const isPressed = pose.pressed[stop.element] === true;
    const carrier = stop.other !== null ? (pose.places[stop.other] ?? 0) : stop.rides ? pose.support : 0;
    for (const { level, above } of stop.levels) {
        const side = above ? 1 : -1;
        const at = (rest[stop.place] ?? 0) + side * (SIZE / 2) + perMetre * (carrier + level);
        context.fillStyle = context.strokeStyle = isPressed ? theme.period(2) : theme.look.pale;
        context.fillRect(above ? at : at - 5, middle - 34, 5, 68);
        if (stop.other !== null) {
            context.lineWidth = 2;
            context.beginPath();
            context.moveTo(at, middle + 32);
            context.lineTo((rest[stop.other] ?? 0) + perMetre * carrier, middle + 32);
            context.stroke();
        }
    }
}
