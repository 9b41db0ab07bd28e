// SPDX-License-Identifier: LGPL-2.1-or-later
// A slider shows the frame of its time in each of its views. Without JavaScript the page shows
// the last time.
document.querySelectorAll(".slider").forEach(function (slider) {
  "use strict";
  const input = slider.querySelector("input");
  const button = slider.querySelector("button");
  const output = slider.querySelector("output");
  const times = slider.querySelectorAll(".times li");
  let timer = null;

  function show() {
    const shown = Number(input.value);
    slider.querySelectorAll(".view").forEach(function (view) {
      view.querySelectorAll(".frame").forEach(function (frame, k) {
        frame.hidden = k !== shown;
      });
    });
    output.textContent = times[shown].textContent;
  }

  function stop() {
    clearInterval(timer);
    timer = null;
    button.textContent = "Play";
  }

  function step() {
    input.value = Number(input.value) + 1;
    show();
    if (input.value === input.max) {
      stop();
    }
  }

  button.addEventListener("click", function () {
    if (timer !== null) {
      stop();
      return;
    }
    if (input.value === input.max) {
      input.value = 0;
      show();
    }
    timer = setInterval(step, 200);
    button.textContent = "Pause";
  });
  input.addEventListener("input", function () {
    stop();
    show();
  });
  show();
});
