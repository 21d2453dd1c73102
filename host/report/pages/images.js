// Images of linear values, and the colours that they and errors have on the screen.
const missing = [0, 184, 196];

const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

// The value of every 16-bit float, times the images' scale.
const halves = new Float32Array(65536);
for (let h = 0; h < 65536; ++h) {
  const exponent = (h >> 10) & 31, fraction = h & 1023;
  let v = exponent === 0 ? fraction * 2 ** -24 : (1024 + fraction) * 2 ** (exponent - 25);
  if (exponent === 31) v = fraction ? NaN : Infinity;
  halves[h] = (h & 0x8000 ? -v : v) * data.scale;
}
/// R, G and B of every pixel, as packed_halves (packed_image.h) packs them.
const pixelsOf = (text) => {
  const bytes = bytesOf(text), values = new Float32Array(bytes.length / 2);
  for (let i = 0; i < values.length; ++i)
    values[i] = halves[bytes[2 * i] | (bytes[2 * i + 1] << 8)];
  return values;
};
const encode = (linear) =>
    linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
// sRGB codes by interpolation in steps of the linear value's square root.
const encoded = Float32Array.from({length: 4098}, (_, i) => 255 * encode((i / 4096) ** 2));
const codeOf = (v) => {
  const x = 4096 * Math.sqrt(Math.min(Math.max(v, 0), 1)), i = Math.floor(x);
  return Math.round(encoded[i] + (encoded[i + 1] - encoded[i]) * (x - i));
};

// Colours of rising OKLab lightness (B. Ottosson, 2020) from near black over purple and orange to
// pale yellow, so that a larger error always looks brighter.
const colourOf = (t) => {
  const lightness = 0.12 + 0.85 * t, hue = (285 + 175 * t) * Math.PI / 180;
  const chroma = 0.02 + 0.19 * Math.sin(Math.PI * Math.min(1, 0.08 + 0.86 * t)) ** 0.9;
  const p = chroma * Math.cos(hue), q = chroma * Math.sin(hue);
  const l = (lightness + 0.3963377774 * p + 0.2158037573 * q) ** 3;
  const m = (lightness - 0.1055613458 * p - 0.0638541728 * q) ** 3;
  const s = (lightness - 0.0894841775 * p - 1.2914855480 * q) ** 3;
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s
  ].map((v) => Math.round(255 * encode(Math.min(Math.max(v, 0), 1))));
};
const palette = Array.from({length: 256}, (_, i) => i === 255 ? missing : colourOf(i / 254));

const paint = (canvas, colour) => {
  const context = canvas.getContext('2d'),
        image = context.createImageData(canvas.width, canvas.height);
  for (let i = 0; i < image.data.length / 4; ++i) {
    const [red, green, blue] = colour(i);
    image.data.set([red, green, blue, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
};
const exposureText = (stops) => `${stops > 0 ? '+' : ''}${stops} EV`;
/// Linear values on an sRGB display, times a factor.
const paintLinear = (canvas, values, factor) => paint(canvas, (i) => {
  const red = values[3 * i], green = values[3 * i + 1], blue = values[3 * i + 2];
  return Number.isFinite(red + green + blue) ?
      [codeOf(factor * red), codeOf(factor * green), codeOf(factor * blue)] :
      missing;
});
