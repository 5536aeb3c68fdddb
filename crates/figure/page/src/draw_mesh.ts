// A mesh in motion, seen from a corner in parallel, on a canvas: at rest in grey, moving in colour.

import type { Mesh, Structure } from "./data";
import type { Pose } from "./motion";
import type { Sketch } from "./sketch";

/** Where a place of space is seen: to the right and upwards, as in printed figures. */
function projected([x, y, z]: readonly [number, number, number]): [number, number] {
    return [(x - y) * 0.866, z + 0.25 * (x + y)];
}

/**
 * Draws a mesh; the largest displacement is a tenth of its size. Returns how many times larger than lengths
 * displacements are drawn.
 *
 * * `largest`: displacement of the whole motion (m).
 */
export function drawMesh(
    { context, width, height, theme }: Sketch,
    structure: Structure,
    mesh: Mesh,
    pose: Pose,
    largest: number,
): number {
    const seen = mesh.nodes.map(projected);
    const ends = [0, 1].map((axis) => {
        const values = seen.map((place) => place[axis] ?? 0);
        return [Math.min(...values), Math.max(...values)] as const;
    });
    const extent = ends.map(([low, high]) => high - low || 1e-9);
    const perMetre = Math.min((0.75 * width) / (extent[0] ?? 1), (0.7 * height) / (extent[1] ?? 1));
    const size = Math.max(...extent);
    const enlarged = (0.1 * size) / (largest || 1);
    const middle = ends.map(([low, high]) => (low + high) / 2);
    const at = ([x, y]: readonly [number, number]): [number, number] => [
        width / 2 + perMetre * (x - (middle[0] ?? 0)),
        height / 2 - perMetre * (y - (middle[1] ?? 0)),
    ];
    const moved = mesh.nodes.map(([x, y, z], k): [number, number, number] => {
        const [dx, dy, dz] = pose.mesh[k] ?? [0, 0, 0];
        return [x + enlarged * dx, y + enlarged * dy, z + enlarged * dz];
    });
    const draw = (places: [number, number][], colour: string, thick: number): void => {
        context.strokeStyle = colour;
        context.lineWidth = thick;
        context.beginPath();
        for (const [from, to] of mesh.lines) {
            context.moveTo(...(places[from] ?? [0, 0]));
            context.lineTo(...(places[to] ?? [0, 0]));
        }
        context.stroke();
    };
    draw(seen.map(at), theme.look.grid, 1);
    const now = moved.map((place) => at(projected(place)));
    draw(now, theme.period(1), 1.2);
    mesh.places.forEach((node, place) => {
        const where = node === null ? undefined : now[node];
        if (where === undefined) {
            return;
        }
        const isPressed = structure.stops.some(
            (stop) => (stop.place === place || stop.other === place) && pose.pressed[stop.element] === true,
        );
        context.beginPath();
        context.arc(...where, 5, 0, 2 * Math.PI);
        context.fillStyle = isPressed ? theme.period(2) : theme.period(1);
        context.fill();
        context.fillStyle = theme.look.ink;
        context.font = "12px system-ui, sans-serif";
        context.textAlign = "left";
        context.fillText(structure.places[place]?.name ?? "", where[0] + 8, where[1] - 6);
    });
    return enlarged;
}
