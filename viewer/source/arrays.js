/* Numbers as pages carry them. */

/** Decodes base64 into a typed array; the data is little-endian, as every browser's machine is. */
export function decodeArray(text, Type) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
  return new Type(bytes.buffer);
}

/** Index of the last element not greater than the value, in ascending numbers; 0 if there is none. */
export function lastNotAfter(values, value) {
  let low = 0, high = values.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (values[middle] <= value) low = middle; else high = middle - 1;
  }
  return low;
}
