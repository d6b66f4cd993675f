// Puts the page together.

// Address: ?t=12.5&robot=3 or #t=12.5&robot=3; the part behind # wins and is kept up to date.
function readAddress() {
  const sources = [new URLSearchParams(location.search), new URLSearchParams(location.hash.slice(1))];
  const value = (name) => sources.map((source) => source.get(name)).filter((text) => text !== null && text.trim() !== "").pop();
  if (value("robot") !== undefined) chooseRobot(robotWithId(Number(value("robot"))));
  if (value("t") !== undefined) setTime(Number(value("t")));
}

let addressTimer = 0;
let writtenAddress = "";
function paintAddress() {
  if (state.playing) return;
  clearTimeout(addressTimer);
  addressTimer = setTimeout(() => {
    const address = `#t=${Number(state.time.toFixed(2))}${state.robot ? `&robot=${state.robot.id}` : ""}`;
    if (address === writtenAddress) return;
    writtenAddress = address;
    try {
      history.replaceState(null, "", address);
    } catch {
      // Some browsers refuse for files; the page works without.
    }
  }, 400);
}

fillHeader();
fillLayers();
connect();
window.addEventListener("hashchange", readAddress);
state.robot = robotWithId(run.events.find((event) => event.kind === "contact")?.robot) ?? run.robots[0] ?? null;
readAddress();
listEvents();
readColors();
painters.push(paintControls, paintScene, paintTimeline, paintSlider, paintNow, paintDetails, paintCandidates, paintEvents,
  paintCharts, paintAddress);
const [boundsLeft, boundsBottom, boundsRight, boundsTop] = run.bounds;
view.x = (boundsLeft + boundsRight) / 2;
view.y = (boundsBottom + boundsTop) / 2;
themeChanged();
