// The series of an orbit from its record (see page/orbits/record.rs of the figure crate, which says what
// stands in it).

import { Kind, RangeDecoder } from "./range_decoder";

/** Steps in a power of ten of a spectrum. */
const STEPS_OF_A_DECADE = 50;
const MOST_STEPS = 4194304;

type Of =
    | "head"
    | "acceleration"
    | "velocity"
    | "displacement"
    | "support"
    | "forces"
    | "modes"
    | "spectrum"
    | "inContacts";

/** An impact on a rigid stop. */
export interface Impulse {
    element: number;
    /** Excitation periods since phase 0. */
    cycles: number;
    /** Along the relative displacement of the element (N s). */
    impulse: number;
    displacement: number;
    velocity: [before: number, after: number];
}

export interface OrbitRecord {
    displacement: Float64Array;
    velocity: Float64Array;
    acceleration: Float64Array;
    support: Float64Array;
    forces: Float64Array[];
    modes: Float64Array[];
    spectrum: Float64Array;
    /** Numbers of the samples before, displacements and velocities. */
    inContacts: [Float64Array, Float64Array, Float64Array];
    impulses: Impulse[];
}

/** A series as whole numbers of steps. */
interface Stepped {
    size: number;
    counts: Int32Array;
}

const valuesOf = ({ size, counts }: Stepped): Float64Array =>
    Float64Array.from(counts, (count) => size * count);
const asFloat = new DataView(new ArrayBuffer(4));

function single(bits: number): number {
    asFloat.setUint32(0, bits);
    return asFloat.getFloat32(0);
}

function rounded(number: number): number {
    return Number.isNaN(number) ? 0 : Math.min(MOST_STEPS, Math.max(-MOST_STEPS, Math.floor(number + 0.5)));
}

class Reader {
    private readonly decoder: RangeDecoder;
    private readonly kinds = new Map<Of, Kind>();

    constructor(bytes: Uint8Array) {
        this.decoder = new RangeDecoder(bytes);
    }

    size(): number {
        return single(this.decoder.plain(16) * 65536);
    }

    float(): number {
        return single(this.decoder.plain(32));
    }

    numbers(of: Of, count: number): Int32Array {
        const kind = this.kinds.get(of) ?? new Kind();
        this.kinds.set(of, kind);
        kind.begin();
        const numbers = new Int32Array(count);
        for (let k = 0; k < count; k++) {
            numbers[k] = kind.number(this.decoder);
        }
        return numbers;
    }

    /**
     * Numbers from what a predictor misses them by: those of each order are sums of those of the order below.
     */
    counts(of: Of, count: number): Int32Array {
        const order = this.numbers("head", 1)[0] ?? 0;
        const counts = this.numbers(of, count);
        for (let n = 0; n < order; n++) {
            for (let k = 1; k < count; k++) {
                counts[k] = (counts[k] ?? 0) + (counts[k - 1] ?? 0);
            }
        }
        return counts;
    }

    series(of: Of, count: number): Stepped {
        return { size: this.size(), counts: this.counts(of, count) };
    }

    /**
     * A series that is continued by something else: `change` is by how many steps it changes behind its value
     * of that number.
     */
    continued(of: Of, count: number, change: (size: number, k: number) => number): Stepped {
        const size = this.size();
        const counts = this.numbers(of, count);
        for (let k = 1; k < count; k++) {
            counts[k] = (counts[k] ?? 0) + (counts[k - 1] ?? 0) + rounded(change(size, k - 1));
        }
        return { size, counts };
    }
}

export function readRecord(bytes: Uint8Array): OrbitRecord {
    const reader = new Reader(bytes);
    const repeated = <T>(count: number, one: () => T): T[] => Array.from({ length: count }, one);
    const head = reader.numbers("head", 8);
    const [samples = 0, elements = 0, ofSupport = 0, modes = 0] = head;
    const [ofMode = 0, harmonics = 0, inside = 0, impulses = 0] = head.slice(4);
    const distance = reader.size();
    const acceleration = reader.series("acceleration", 2 * samples);
    const a = (k: number): number => acceleration.counts[k] ?? 0;
    const velocity = reader.continued("velocity", samples, (size, k) => {
        const sum = a(2 * k) + 4 * a(2 * k + 1) + a(2 * k + 2);
        return (distance * acceleration.size * sum) / 6 / size;
    });
    const v = (k: number): number => velocity.counts[k] ?? 0;
    const displacement = reader.continued("displacement", samples, (size, k) => {
        const sum = v(k) + v(k + 1);
        const bend = a(2 * k + 2) - a(2 * k);
        return (distance * ((velocity.size * sum) / 2 - (distance * acceleration.size * bend) / 12)) / size;
    });
    const support = reader.series("support", ofSupport);
    const forces = repeated(elements, () => valuesOf(reader.series("forces", 2 * samples)));
    const size = reader.size();
    return {
        displacement: valuesOf(displacement),
        velocity: valuesOf(velocity),
        acceleration: valuesOf(acceleration),
        support: valuesOf(support),
        forces,
        modes: repeated(modes, () => valuesOf({ size, counts: reader.counts("modes", ofMode) })),
        spectrum: valuesOf({ size: 1 / STEPS_OF_A_DECADE, counts: reader.counts("spectrum", harmonics) }),
        inContacts: [
            valuesOf({ size: 1, counts: reader.counts("inContacts", inside) }),
            valuesOf({ size: displacement.size, counts: reader.counts("inContacts", inside) }),
            valuesOf({ size: velocity.size, counts: reader.counts("inContacts", inside) }),
        ],
        impulses: repeated(impulses, () => {
            const element = reader.numbers("head", 1)[0] ?? 0;
            const [cycles, impulse, at] = [reader.float(), reader.float(), reader.float()];
            const [before, after] = [reader.float(), reader.float()];
            return { element, cycles, impulse, displacement: at, velocity: [before, after] };
        }),
    };
}
