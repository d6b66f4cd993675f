// Charts of the chosen robot. They come drawn (report/replay_charts.cpp): a template for every robot, a picture for
// every chart. Here they are shown, with a cursor at the present time and the present values beside the legend.

/** Present values of a chart's series, in the order of its legend. */
const READINGS = {
  wheels: (robot) => robot.wheels.map((values) => `${formatted(nowIn(values), 2)} m/s`),
  clearance: ({ clearance: { obstacle, peer, static: fixed } }) => [obstacle, peer, fixed].map(({ distance }) => `${formatted(nowIn(distance), 2)} m`),
  computing: (robot) => {
    const plan = planNewest(robot, state.time);
    return [formattedDuration(nowIn(robot.control)), plan ? `${formattedDuration(plan.computing)}, ${plan.evaluations} evaluations` : ""];
  },
};

const charts = Object.entries(READINGS).map(([name, reading]) => {
  const chart = { reading, box: document.getElementById(`chart-${name}`), values: document.querySelectorAll(`#legend-${name} b`) };
  scrubOn(chart.box, () => (chart.area ?? chart.box).getBoundingClientRect());
  return chart;
});
let chartsOf = null;  // the robot whose charts are shown

function showCharts(robot) {
  chartsOf = robot;
  const pictures = [...document.querySelectorAll("template")[robot.position].content.cloneNode(true).children];
  charts.forEach((chart, i) => {
    chart.box.replaceChildren(pictures[i]);
    chart.area = pictures[i].querySelector(".area");
    chart.cursor = pictures[i].appendChild(chart.area.cloneNode());
    chart.cursor.setAttribute("class", "cursor");
    chart.cursor.setAttribute("width", 1.4);
  });
}

function paintCharts() {
  const { robot } = state;
  if (!robot) return;
  if (robot !== chartsOf) showCharts(robot);
  const share = run.duration > 0 ? state.time / run.duration : 0;
  for (const { area, cursor, values, reading } of charts) {
    cursor.setAttribute("x", area.x.baseVal.value + share * area.width.baseVal.value - 0.7);
    reading(robot).forEach((text, i) => setText(values[i], text));
  }
}
