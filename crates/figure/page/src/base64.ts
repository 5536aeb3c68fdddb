// Base64 (RFC 4648) to bytes.

/** What browsers of 2025 have of their own. */
type Decoding = { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };

export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
    const { fromBase64 } = Uint8Array as Decoding;
    if (fromBase64 !== undefined) {
        return fromBase64.call(Uint8Array, text);
    }
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let k = 0; k < bytes.length; k++) {
        bytes[k] = binary.charCodeAt(k);
    }
    return bytes;
}
