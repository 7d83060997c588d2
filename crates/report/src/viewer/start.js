// Starts the viewer, or leaves the note that it cannot.

try {
  new Viewer(JSON.parse(element("scene").textContent), decode(element("codes").textContent));
} catch (error) {
  element("root").hidden = true;
  element("missing").hidden = false;
  console.warn(`The vessel cannot be turned here: ${error.message}`);
}
