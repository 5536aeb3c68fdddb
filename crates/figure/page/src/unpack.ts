// Columns of numbers as the page carries them: second differences of their bits, byte by byte, deflated (see
// packed.rs of the figure crate).

import { bytesOf } from "./base64";

/** The bytes of a deflated text in base64. */
export async function inflated(text: string): Promise<Uint8Array<ArrayBuffer>> {
    if (text === "") {
        return new Uint8Array(0);
    }
    const stream = new Blob([bytesOf(text)]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new Uint8Array(await new globalThis.Response(stream).arrayBuffer());
}

/** Reads columns from the first byte on. */
export class Unpacker {
    private at = 0;

    constructor(private readonly bytes: Uint8Array<ArrayBuffer>) {}

    double(count: number): Float64Array<ArrayBuffer> {
        const [low, high] = [new Uint32Array(count), new Uint32Array(count)];
        this.plane(low, 4);
        this.plane(high, 4);
        const words = new Uint32Array(2 * count);
        let [valueLow, valueHigh, stepLow, stepHigh] = [0, 0, 0, 0];
        for (let k = 0; k < count; k++) {
            const [a, b] = [low[k] ?? 0, high[k] ?? 0];
            // Even numbers are differences from 0 on, odd ones those from −1 down.
            const flip = a & 1 ? 0xffffffff : 0;
            const differenceLow = (((a >>> 1) | (b << 31)) ^ flip) >>> 0;
            const differenceHigh = ((b >>> 1) ^ flip) >>> 0;
            const sum = stepLow + differenceLow;
            stepHigh = (stepHigh + differenceHigh + (sum > 0xffffffff ? 1 : 0)) >>> 0;
            stepLow = sum >>> 0;
            const next = valueLow + stepLow;
            valueHigh = (valueHigh + stepHigh + (next > 0xffffffff ? 1 : 0)) >>> 0;
            valueLow = next >>> 0;
            words[2 * k] = valueLow;
            words[2 * k + 1] = valueHigh;
        }
        return new Float64Array(words.buffer);
    }

    single(count: number): Float32Array<ArrayBuffer> {
        return new Float32Array(this.whole(count, 4).buffer);
    }

    /** Numbers without sign of one to four bytes. */
    whole(count: number, width: number): Uint32Array<ArrayBuffer> {
        const values = new Uint32Array(count);
        this.plane(values, width);
        const [mask, top] = [width === 4 ? 0xffffffff : 2 ** (8 * width) - 1, 8 * width - 1];
        let [value, step] = [0, 0];
        for (let k = 0; k < count; k++) {
            const coded = values[k] ?? 0;
            step += coded & 1 ? ~(coded >>> 1) & (top === 31 ? 0xffffffff : mask) : coded >>> 1;
            step = (step & mask) >>> 0;
            value = ((value + step) & mask) >>> 0;
            values[k] = value;
        }
        return values;
    }

    /** Bytes of numbers, the lowest ones of all numbers first. */
    private plane(values: Uint32Array, width: number): void {
        for (let byte = 0; byte < width; byte++) {
            for (let k = 0; k < values.length; k++) {
                values[k] = (values[k] ?? 0) | ((this.bytes[this.at + k] ?? 0) << (8 * byte));
            }
            this.at += values.length;
        }
    }
}
