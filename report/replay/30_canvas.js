// Shared by everything drawn: colours of the palette, sharp canvases, number formats.

const prefersDark = matchMedia("(prefers-color-scheme: dark)");
let colors = {};

function readColors() {
  const style = getComputedStyle(document.documentElement);
  const names = ["page", "panel", "raised", "line", "grid", "control", "text", "muted", "accent", "on-accent", "good", "bad",
    "caution", "obstacle", "wall", "perceived", "robot-0", "robot-1", "robot-2", "robot-3", "robot-4"];
  colors = Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}

/** #rrggbb with an opacity in [0, 1]. */
const faded = (color, opacity) => color + Math.round(255 * opacity).toString(16).padStart(2, "0");

const FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, 'Noto Sans', sans-serif";

/** Fits a canvas to its CSS size and the screen's density; that clears it, so the caller draws afterwards. */
function fitCanvas(canvas) {
  const box = canvas.getBoundingClientRect();
  const density = Math.min(window.devicePixelRatio || 1, 3);
  const width = Math.max(1, Math.round(box.width * density));
  const height = Math.max(1, Math.round(box.height * density));
  const changed = canvas.width !== width || canvas.height !== height;
  if (changed) {
    canvas.width = width;
    canvas.height = height;
  }
  const context = canvas.getContext("2d");
  context.setTransform(density, 0, 0, density, 0, 0);
  return { context, width: box.width, height: box.height, changed };
}

/** A minus sign as printed, and a dash for what is not known. */
function formatted(value, decimals) {
  if (!Number.isFinite(value)) return "\u2013";
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "\u2212");
}

function formattedDuration(seconds) {
  if (!Number.isFinite(seconds)) return "\u2013";
  if (seconds < 0.9995e-3) return `${formatted(seconds * 1e6, seconds < 10e-6 ? 1 : 0)} \u00b5s`;
  return seconds < 0.9995 ? `${formatted(seconds * 1e3, seconds < 10e-3 ? 2 : 1)} ms` : `${formatted(seconds, 2)} s`;
}

/** Steps of 1, 2 or 5 times a power of ten that put at most `count` ticks into the span. */
function tickStep(span, count) {
  const raw = Math.max(span, 1e-12) / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= raw * 0.999);
}

function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}
