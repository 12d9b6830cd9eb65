// An image that is replaced without flicker.  It tells what the pointer does on it, "press", "drag", "release" and, if the
// pointer stayed where it was, "click", and where, as shares of its width and height.
function render({ model, el }) {
  const image = document.createElement("img");
  image.className = "camkit-image";
  let shown = null;
  const show = () => {
    const url = URL.createObjectURL(new Blob([model.get("data")], { type: model.get("mime") }));
    image.src = url;
    if (shown) URL.revokeObjectURL(shown);
    shown = url;
  };
  const describe = () => { image.alt = model.get("description"); };
  let pressed = null, moved = null, waiting = 0;
  const tell = (kind, event) => {
    const box = image.getBoundingClientRect();
    model.send({ kind, x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height });
  };
  const follow = () => { // the next drag is told when the picture has followed the last one, or soon after
    clearTimeout(waiting);
    waiting = 0;
    if (!moved) return;
    tell("drag", moved);
    moved = null;
    waiting = setTimeout(follow, 150);
  };
  image.draggable = false;
  image.addEventListener("pointerdown", (event) => {
    pressed = event;
    image.setPointerCapture(event.pointerId);
    tell("press", event);
  });
  image.addEventListener("pointermove", (event) => {
    if (!pressed) return;
    moved = event;
    if (!waiting) follow();
  });
  image.addEventListener("pointerup", (event) => {
    if (!pressed) return;
    const still = Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) < 4;
    pressed = null;
    follow();
    tell("release", event);
    if (still) tell("click", event);
  });
  image.addEventListener("pointercancel", () => { pressed = moved = null; });
  model.on("change:data", show);
  model.on("change:data", follow);
  model.on("change:description", describe);
  show();
  describe();
  el.appendChild(image);
  return () => {
    model.off("change:data", show);
    model.off("change:data", follow);
    model.off("change:description", describe);
    URL.revokeObjectURL(shown);
  };
}
export default { render };
