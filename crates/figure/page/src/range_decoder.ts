// Whole numbers from bits: the other half of page/orbits/coder.rs of the figure crate, which says how they
// are written.

const LEAST_RANGE = 2 ** 24;
const SUMS = 16;
const LENGTHS = 33;
const MET = [2, 40] as const;

/** Probabilities of bits that are not set, in 65 536ths, and how often each was met. */
class Odds {
    readonly unset: Int32Array;
    readonly met: Int32Array;

    constructor(first: number[]) {
        this.unset = Int32Array.from(first);
        this.met = new Int32Array(first.length).fill(MET[0]);
    }

    learn(place: number, isSet: boolean): void {
        const [unset, met] = [this.unset[place] ?? 0, this.met[place] ?? 0];
        const learned = unset + Math.trunc(((isSet ? 0 : 65536) - unset) / (met + 1));
        this.unset[place] = Math.min(65536 - 64, Math.max(64, learned));
        this.met[place] = Math.min(met + 1, MET[1]);
    }
}

const FIRST = Array.from({ length: SUMS * LENGTHS }, (_, place) => {
    const [sum, length] = [Math.floor(place / LENGTHS), place % LENGTHS];
    return Math.min(61440, Math.max(4096, 32768 + 6000 * (2 * length - sum)));
});

/** What was learned of the numbers of a kind. */
export class Kind {
    private readonly longer = new Odds(FIRST);
    private readonly belowLeading = new Odds(new Array<number>(LENGTHS).fill(32768));
    private before: [number, number] = [0, 0];

    /** Another series begins. */
    begin(): void {
        this.before = [0, 0];
    }

    number(decoder: RangeDecoder): number {
        const row = Math.min(this.before[0] + this.before[1], SUMS - 1) * LENGTHS;
        let length = 0;
        while (length < LENGTHS - 1 && decoder.bit(this.longer, row + length)) {
            length++;
        }
        this.before = [length, this.before[0]];
        if (length === 0) {
            return 0;
        }
        const sign = decoder.plain(1) === 1 ? -1 : 1;
        if (length === 1) {
            return sign;
        }
        const leading = decoder.bit(this.belowLeading, length) ? 3 : 2;
        return sign * (leading * 2 ** (length - 2) + decoder.plain(length - 2));
    }
}

export class RangeDecoder {
    private at = 0;
    private code = 0;
    private range = 0xffffffff;

    constructor(private readonly bytes: Uint8Array) {
        for (let k = 0; k < 4; k++) {
            this.code = this.code * 256 + this.next();
        }
    }

    bit(odds: Odds, place: number): boolean {
        const bound = (this.range >>> 16) * (odds.unset[place] ?? 0);
        const isSet = this.code >= bound;
        if (isSet) {
            this.code -= bound;
            this.range -= bound;
        } else {
            this.range = bound;
        }
        odds.learn(place, isSet);
        this.fill();
        return isSet;
    }

    /** So many bits as they are, the highest first. */
    plain(bits: number): number {
        let number = 0;
        for (let k = 0; k < bits; k++) {
            this.range = this.range >>> 1;
            const isSet = this.code >= this.range;
            if (isSet) {
                this.code -= this.range;
            }
            this.fill();
            number = 2 * number + (isSet ? 1 : 0);
        }
        return number;
    }

    private fill(): void {
        while (this.range < LEAST_RANGE) {
            this.range *= 256;
            this.code = this.code * 256 + this.next();
        }
    }

    private next(): number {
        return this.bytes[this.at++] ?? 0;
    }
}
