// A beam in motion against its stops, on a canvas.

import type { Structure } from "./data";
import { carrierOf, type Pose } from "./motion";
import { hatched, type Sketch } from "./sketch";

/**
 * Draws a beam; `perMetre` is for displacements. Returns how many times larger than lengths they are drawn.
 */
export function drawBeam(sketch: Sketch, structure: Structure, pose: Pose, perMetre: number): number {
    const { context, width, height, theme } = sketch;
    const positions = structure.places.map((place) => place.at);
    const length = Math.max(...positions) || 1;
    const margin = 46;
    const along = (width - 2 * margin) / length;
    const middle = height / 2;
    const x = (place: number): number => margin + (positions[place] ?? 0) * along;
    const y = (displacement: number): number => middle - displacement * perMetre;
    const tip = structure.places.length - 1;

    context.setLineDash([4, 4]);
    context.lineWidth = 1;
    context.strokeStyle = theme.look.pale;
    line(context, x(0), middle, x(tip), middle);
    context.setLineDash([]);
    for (const end of [0, tip]) {
        const place = structure.places[end];
        if (place !== undefined && place.shape.every((value) => value === 0)) {
            const outward = end === 0 ? -1 : 1;
            const at = y(pose.places[end] ?? 0);
            hatched(sketch, [x(end) + (outward < 0 ? -14 : 0), at - 26, 14, 52], theme.look.ink);
        }
    }
    for (const stop of structure.stops) {
        const isPressed = pose.pressed[stop.element] === true;
        const carrier = carrierOf(stop, pose);
        for (const { level, above } of stop.levels) {
            drawStop(sketch, x(stop.place), y(carrier + level), above, isPressed);
        }
    }
    context.lineJoin = "round";
    context.lineWidth = 4;
    context.strokeStyle = theme.period(1);
    context.beginPath();
    pose.places.forEach((displacement, place) => context.lineTo(x(place), y(displacement)));
    context.stroke();
    structure.places.forEach((place, k) => {
        if (place.name !== "") {
            const at = y(pose.places[k] ?? 0);
            context.beginPath();
            context.arc(x(k), at, 5, 0, 2 * Math.PI);
            context.fillStyle = theme.period(1);
            context.fill();
        }
    });
    return perMetre / along;
}

/**
 * A wedge whose point is where the stop is touched, half the width of the line away from the middle of the
 * beam.
 */
function drawStop(
    { context, theme }: Sketch,
    x: number,
    y: number,
    above: boolean,
    isPressed: boolean,
): void {
    const away = above ? -1 : 1;
    const point = y + 4 * away;
    context.beginPath();
    context.moveTo(x, point);
    context.lineTo(x - 13, point + 24 * away);
    context.lineTo(x + 13, point + 24 * away);
    context.closePath();
    context.fillStyle = isPressed ? theme.period(2) : theme.look.pale;
    context.fill();
}

function line(context: CanvasRenderingContext2D, x1: number, y1: number, x2: number, y2: number): void {
    context.beginPath();
    context.moveTo(x1, y1);
    context.lineTo(x2, y2);
    context.stroke();
}
