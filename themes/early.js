// The theme is set before the first paint, so that a dark page does not flash light.
(function () {
  "use strict";
  try {
    var theme = localStorage.getItem("rungbook-theme");
    if (theme === "light" || theme === "dark") document.documentElement.dataset.theme = theme;
  } catch (e) {
    // Storage may be refused, from file:// above all; the system's theme stands.
  }
  document.documentElement.classList.add("js");
})();
