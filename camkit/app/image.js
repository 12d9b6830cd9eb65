// An image that is replaced without flicker and tells where it was clicked, as shares of its width and height.
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
  image.addEventListener("click", (event) => {
    const box = image.getBoundingClientRect();
    model.send({ x: (event.clientX - box.left) / box.width, y: (event.clientY - box.top) / box.height });
  });
  model.on("change:data", show);
  model.on("change:description", describe);
  show();
  describe();
  el.appendChild(image);
  return () => {
    model.off("change:data", show);
    model.off("change:description", describe);
    URL.revokeObjectURL(shown);
  };
}
export default { render };
