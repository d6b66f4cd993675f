// Charts of the chosen robot over time. The lines are drawn once per robot, size and palette; the cursor every frame.

const PAD = { left: 62, right: 10, top: 8, bottom: 34 };
const DASHES = [[], [7, 3], [2, 3]];

/**
 * A chart. `describe(robot)` gives { lines, dots, limits, low, high, log, unit, label }:
 * lines [{ name, values, color, dash }] with one value per frame, dots [{ name, points: [[time, value, failed]], color }],
 * limits [{ value, text }]; `reading(robot)` gives the legend's present values as [[name, text]].
 */
class Chart {
  constructor(name, describe, reading) {
    this.canvas = document.getElementById(`chart-${name}`);
    this.legend = document.getElementById(`legend-${name}`);
    this.describe = describe;
    this.reading = reading;
    this.base = document.createElement("canvas");
    this.key = "";
    scrubOn(this.canvas, (px) => this.timeAt(px));
  }

  timeAt(px) {
    const inner = Math.max(1, this.canvas.getBoundingClientRect().width - PAD.left - PAD.right);
    return ((px - PAD.left) / inner) * run.duration;
  }

  x(time) { return PAD.left + (run.duration > 0 ? time / run.duration : 0) * (this.width - PAD.left - PAD.right); }

  y(value) {
    const { low, high, log } = this.content;
    const share = log ? Math.log(Math.max(value, low) / low) / Math.log(high / low) : (value - low) / (high - low);
    return this.height - PAD.bottom - Math.min(Math.max(share, -0.5), 1.5) * (this.height - PAD.top - PAD.bottom);
  }

  paint() {
    const { context, width, height } = fitCanvas(this.canvas);
    this.width = width;
    this.height = height;
    const key = [state.robot?.id, this.canvas.width, this.canvas.height, colors.panel, colors.text].join();
    if (key !== this.key) {
      this.key = key;
      this.content = this.describe(state.robot);
      this.paintBase();
      this.paintLegend();
    }
    context.clearRect(0, 0, width, height);
    context.drawImage(this.base, 0, 0, width, height);
    const x = Math.round(this.x(state.time)) + 0.5;
    context.strokeStyle = colors.text;
    context.lineWidth = 1.25;
    context.beginPath();
    context.moveTo(x, PAD.top - 4);
    context.lineTo(x, height - PAD.bottom);
    context.stroke();
    this.reading(state.robot).forEach((text, i) => this.values[i] && setText(this.values[i], text));
  }

  paintBase() {
    this.base.width = this.canvas.width;
    this.base.height = this.canvas.height;
    const context = this.base.getContext("2d");
    context.setTransform(this.canvas.width / this.width, 0, 0, this.canvas.height / this.height, 0, 0);
    this.paintAxes(context);
    this.paintLimits(context);
    for (const dots of this.content.dots || []) this.paintDots(context, dots);
    for (const line of this.content.lines) this.paintLine(context, line);
    this.canvas.setAttribute("aria-label", this.content.label);
  }

  paintAxes(context) {
    const { unit } = this.content;
    context.font = `11px ${FONT}`;
    context.lineWidth = 1;
    context.strokeStyle = colors.line;
    context.fillStyle = colors.muted;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const [value, text] of this.ticks()) {
      const y = Math.round(this.y(value)) + 0.5;
      context.beginPath();
      context.moveTo(PAD.left, y);
      context.lineTo(this.width - PAD.right, y);
      context.stroke();
      context.fillText(text, PAD.left - 6, y);
    }
    context.textAlign = "center";
    context.textBaseline = "top";
    const step = tickStep(run.duration, (this.width - PAD.left) / 60);
    for (let i = 0; i * step <= run.duration + 1e-9; ++i) {
      context.fillText(formatted(i * step, step < 1 ? 1 : 0), this.x(i * step), this.height - PAD.bottom + 5);
    }
    context.fillText("time [s]", (PAD.left + this.width - PAD.right) / 2, this.height - 13);
    context.save();
    context.translate(7, (PAD.top + this.height - PAD.bottom) / 2);
    context.rotate(-Math.PI / 2);
    context.textBaseline = "middle";
    context.fillText(unit, 0, 0);
    context.restore();
  }

  ticks() {
    const { low, high, log } = this.content;
    const list = [];
    if (log) {
      for (let value = low; value <= high * 1.001; value *= 10) list.push([value, formattedDuration(value).replace(/\.0+(?=\D)/, "")]);
      return list;
    }
    const step = tickStep(high - low, 5);
    const decimals = Math.max(0, Math.ceil(-Math.log10(step) - 1e-9));
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9; ++i) list.push([i * step, formatted(i * step, decimals)]);
    return list;
  }

  paintLimits(context) {
    for (const { value, text } of this.content.limits || []) {
      const y = Math.round(this.y(value)) + 0.5;
      context.strokeStyle = colors.limit;
      context.lineWidth = 1.5;
      context.setLineDash([8, 4]);
      context.beginPath();
      context.moveTo(PAD.left, y);
      context.lineTo(this.width - PAD.right, y);
      context.stroke();
      context.setLineDash([]);
      if (!text) continue;
      context.fillStyle = colors.limit;
      context.textAlign = "right";
      context.textBaseline = "bottom";
      context.fillText(text, this.width - PAD.right - 2, y - 2);
    }
  }

  paintLine(context, { values, color, dash }) {
    context.save();
    context.beginPath();
    context.rect(PAD.left, PAD.top - 4, this.width - PAD.left - PAD.right, this.height - PAD.top - PAD.bottom + 6);
    context.clip();
    context.beginPath();
    let drawing = false;
    for (let k = 0; k < values.length; ++k) {
      const there = Number.isFinite(values[k]);
      if (there) context[drawing ? "lineTo" : "moveTo"](this.x(k * run.interval), this.y(values[k]));
      drawing = there;
    }
    context.strokeStyle = colors[color];
    context.lineWidth = 1.6;
    context.setLineDash(dash);
    context.stroke();
    context.restore();
  }

  /** Failed plans are crosses, the others dots. */
  paintDots(context, { points, color }) {
    for (const [time, value, failed] of points) {
      if (!Number.isFinite(value)) continue;
      const x = this.x(time), y = this.y(value);
      context.beginPath();
      if (failed) {
        context.moveTo(x - 3, y - 3);
        context.lineTo(x + 3, y + 3);
        context.moveTo(x - 3, y + 3);
        context.lineTo(x + 3, y - 3);
        context.strokeStyle = colors.bad;
        context.lineWidth = 1.6;
        context.stroke();
      } else {
        context.arc(x, y, 2.4, 0, 2 * Math.PI);
        context.fillStyle = colors[color];
        context.fill();
      }
    }
  }

  paintLegend() {
    this.values = [];
    const entries = [
      ...this.content.lines.map((line) => [line.name, line.color, ["solid", "dashed", "dotted"][DASHES.indexOf(line.dash)] || "solid", false]),
      ...(this.content.dots || []).map((dots) => [dots.name, dots.color, "solid", true]),
    ];
    this.legend.replaceChildren(...entries.map(([name, color, style, dot]) => {
      const swatch = make("i", { className: dot ? "dot" : "" });
      if (dot) swatch.style.background = `var(--${color})`; else swatch.style.borderTop = `2.5px ${style} var(--${color})`;
      const value = make("b");
      this.values.push(value);
      return make("span", {}, swatch, name, value);
    }));
  }
}

/** Largest finite absolute value, at least `least`. */
function largest(columns, least) {
  let most = least;
  for (const column of columns) {
    for (const value of column) if (Number.isFinite(value) && Math.abs(value) > most) most = Math.abs(value);
  }
  return most;
}

const nowIn = (values) => values[Math.round(frameNow())];

const CLEARANCES = [["obstacle", "moving obstacle"], ["peer", "robot"], ["static", "static"]];

const charts = [
  new Chart("wheels", (robot) => {
    const limit = robot?.wheelLimit ?? NaN;
    const bound = Number.isFinite(limit) ? limit : 0;
    const high = 1.3 * largest(robot?.wheels ?? [], Math.max(bound, 0.05));
    return {
      lines: (robot?.wheels ?? []).map((values, i) => ({ name: `wheel ${i + 1}`, values, color: `series-${i}`, dash: DASHES[i] })),
      limits: bound > 0 ? [{ value: bound, text: `limit \u00b1${formatted(bound, 2)} m/s` }, { value: -bound }] : [],
      low: -high, high, unit: "rim speed [m/s]", label: `Wheel speeds of robot ${robot?.id} over time, with their limit`,
    };
  }, (robot) => (robot?.wheels ?? []).map((values) => `${formatted(nowIn(values), 2)} m/s`)),

  new Chart("clearance", (robot) => ({
    lines: CLEARANCES.map(([kind, name], i) => ({
      name, values: robot ? robot.clearance[kind].distance : [], color: ["series-1", "series-0", "series-2"][i], dash: DASHES[i],
    })),
    limits: [{ value: 0, text: "contact" }],
    low: -0.4, high: Math.min(6, largest(CLEARANCES.map(([kind]) => robot?.clearance[kind].distance ?? []), 1)),
    unit: "gap [m]", label: `Gaps of robot ${robot?.id} to the nearest moving obstacle, robot and static obstacle over time`,
  }), (robot) => CLEARANCES.map(([kind]) => (robot ? `${formatted(nowIn(robot.clearance[kind].distance), 2)} m` : ""))),

  new Chart("computing", (robot) => {
    const points = (robot?.plans ?? []).map((plan) => [plan.time, plan.computing, plan.x.length === 0]);
    const all = [...points.map((point) => point[1]), ...(robot?.control ?? [])].filter((value) => value > 0);
    const low = 10 ** Math.floor(Math.log10(all.reduce((a, b) => Math.min(a, b), 1e-5)));
    const high = 10 ** Math.ceil(Math.log10(all.reduce((a, b) => Math.max(a, b), 10.1 * low)));
    return {
      lines: [{ name: "control tick", values: robot?.control ?? [], color: "series-0", dash: [] }],
      dots: [{ name: "plan", points, color: "series-1" }],
      low, high, log: true, unit: "log scale", label: `Computing times of robot ${robot?.id}: each plan and each control tick, logarithmic`,
    };
  }, (robot) => {
    const plan = robot && planNewest(robot, state.time);
    return [robot ? formattedDuration(nowIn(robot.control)) : "", plan ? `${formattedDuration(plan.computing)}, ${plan.evaluations} evaluations` : ""];
  }),
];

/** Press and drag on a canvas to move through time; `timeAt` maps its pixels. */
function scrubOn(canvas, timeAt) {
  const go = (event) => setTime(timeAt(event.clientX - canvas.getBoundingClientRect().left));
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pause();
    canvas.setPointerCapture(event.pointerId);
    go(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) go(event);
  });
}
