// Base64 (RFC 4648) to bytes.

export function bytesOf(text: string): Uint8Array<ArrayBuffer> {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let k = 0; k < bytes.length; k++) {
        bytes[k] = binary.charCodeAt(k);
    }
    return bytes;
}
