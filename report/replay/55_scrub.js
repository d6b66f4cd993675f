// Reading and moving through time, for whatever shows it.

const nowIn = (values) => values[Math.round(frameNow())];

/** Press and drag to move through time; `area` gives the left edge and the width [px] of the run's duration. */
function scrubOn(element, area) {
  const go = (event) => {
    const { left, width } = area();
    setTime(((event.clientX - left) / width) * run.duration);
  };
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    pause();
    element.setPointerCapture(event.pointerId);
    go(event);
  });
  element.addEventListener("pointermove", (event) => {
    if (element.hasPointerCapture(event.pointerId)) go(event);
  });
}
