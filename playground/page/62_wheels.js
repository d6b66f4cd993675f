// Wheel speeds of the chosen robot over the last seconds, with their limit.

const WHEEL_SPAN = 12;  // [s]
const wheelCanvas = document.getElementById("wheels");

function paintWheels() {
  const { context, width, height } = fitCanvas(wheelCanvas);
  context.clearRect(0, 0, width, height);
  const robot = state.robot;
  if (!robot || run.frames === 0) return;
  const limit = robot.wheelLimit > 0 ? robot.wheelLimit : 1;
  const x = (time) => 34 + ((time - state.time) / WHEEL_SPAN + 1) * (width - 42);
  const y = (speed) => height / 2 - (speed / (1.15 * limit)) * (height / 2 - 4);
  context.font = `11px ${FONT}`;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const speed of [-limit, 0, limit]) {
    context.strokeStyle = speed === 0 ? colors.control : colors.caution;
    context.setLineDash(speed === 0 ? [] : [4, 4]);
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(34, y(speed));
    context.lineTo(width - 8, y(speed));
    context.stroke();
    context.fillStyle = colors.muted;
    context.fillText(formatted(speed, 1), 30, y(speed));
  }
  context.lineWidth = 1.75;
  const last = frameNow(), first = Math.max(0, Math.ceil(last - WHEEL_SPAN / run.interval));
  robot.wheels.forEach((speeds, wheel) => {
    context.strokeStyle = colors[`robot-${wheel % 5}`];
    context.setLineDash([[], [6, 3], [2, 3], [8, 3, 2, 3]][wheel % 4]);
    context.beginPath();
    for (let k = first; k <= last; ++k) context.lineTo(x(k * run.interval), y(speeds[k]));
    context.lineTo(x(state.time), y(sample(speeds, last)));
    context.stroke();
  });
  context.setLineDash([]);
  const text = robot.wheels.map((speeds) => formatted(sample(speeds, last), 2)).join(", ");
  setText(byId("wheel-values"), `${text} m/s`);
}
