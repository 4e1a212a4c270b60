/* Drawings that move: one with its shapes between the two nearest places for which there are numbers, several on one sheet, and a turn on its own. */
(function () {
  "use strict";
  var GAP = 0.04, CAPTION = 0.022, WIDE = 1.8; /* of the sheet's width: between drawings, of a letter below them; how much wider than high it should be */

  function svg(name, attributes) {
    var node = document.createElementNS("http://www.w3.org/2000/svg", name);
    Object.keys(attributes).forEach(function (key) { node.setAttribute(key, attributes[key]); });
    return node;
  }

  /* The frame: a line, and short strokes below it as in the drawing on paper. */
  function grounded(points, dot) {
    var way = "", at, k;
    for (at = 0; at + 3 < points.length; at += 2) {
      var x = points[at], y = -points[at + 1], across = points[at + 2] - x, down = -points[at + 3] - y, count = Math.floor(Math.hypot(across, down) / (2.8 * dot));
      way += "M" + x + " " + y + "l" + across + " " + down;
      for (k = 1; k < count; k += 1) { way += "M" + (x + across * k / count) + " " + (y + down * k / count) + "l" + -2 * dot + " " + 2 * dot; }
    }
    return way;
  }

  function placed(shape, node, now, dot) {
    if (shape.role === "ground" && shape.shape === "polyline") { node.setAttribute("d", grounded(now, dot)); return; }
    if (shape.shape === "label") { node.setAttribute("x", now[0]); node.setAttribute("y", -now[1]); return; }
    if (shape.shape === "rigid") { node.setAttribute("transform", "translate(" + now[0] + " " + -now[1] + ") rotate(" + -now[2] + ")"); return; }
    if (shape.shape === "polyline") { node.setAttribute("points", now.map(function (value, at) { return at % 2 ? -value : value; }).join(" ")); return; }
    node.setAttribute("cx", now[0]); node.setAttribute("cy", -now[1]); node.setAttribute("r", shape.shape === "circle" ? now[2] : dot);
  }

  /* The nodes of shapes, drawn where they stand still; those that move are told to ``moves``. */
  function drawn(shapes, sheet, dot, moves, letter) {
    shapes.forEach(function (shape) {
      var name = shape.shape === "rigid" ? "g" : shape.shape === "label" ? "text" : shape.role === "ground" && shape.shape === "polyline" ? "path" : shape.shape === "polyline" ? (shape.closed ? "polygon" : "polyline") : "circle";
      var node = svg(name, shape.role ? { "class": "m-" + shape.role } : {});
      sheet.append(node);
      if (shape.grip) { node.dataset.grip = shape.grip.input; node.grip = shape.grip; }
      if (shape.text) { node.setAttribute("class", "m-label " + shape.anchor); node.setAttribute("font-size", letter); node.append(shape.text); }
      if (shape.shapes) { drawn(shape.shapes, node, dot, moves); }
      if (shape.numbers) { placed(shape, node, shape.numbers, dot); } else { moves.push([shape, node]); }
    });
  }

  /* A drawing: its node, and what puts it at a place of its abscissa. ``across``: how much of its unit a point is high, if not a part of its room. */
  window.movingDrawing = function (moving, rows, across) {
    var places = rows[moving.places], dot = across || Math.max(moving.room[2], moving.room[3]) / 90, moves = [];
    var sheet = svg("svg", { viewBox: moving.room.join(" "), role: "img", "aria-label": moving.title, "class": "moving" });
    drawn(moving.shapes, sheet, dot, moves, moving.letter);
    var timed = moving.shapes.map(function (shape, at) { return [shape.during, sheet.children[at]]; }).filter(function (pair) { return pair[0]; });
    if (moving.shapes.some(function (shape) { return shape.text; })) { sheet.classList.add("labelled"); }
    return { node: sheet, at: function (x) {
      var k = 1;
      timed.forEach(function (pair) { pair[1].classList.toggle("m-on", x >= pair[0][0] && x < pair[0][1]); });
      while (k < places.length - 1 && places[k] < x) { k += 1; }
      var share = Math.max(0, Math.min(1, (x - places[k - 1]) / (places[k] - places[k - 1] || 1)));
      moves.forEach(function (pair) {
        placed(pair[0], pair[1], pair[0].rows.map(function (number) {
          var row = rows[number];
          return row.length === 1 ? row[0] : row[k - 1] + share * (row[k] - row[k - 1]);
        }), dot);
      });
    } };
  };

  /* Where drawings of these sizes stand in rows of so many, on the floor of their row, and how large that is. */
  function inRows(sizes, count, gap, caption) {
    var x = 0, y = 0, wide = 0, found = [];
    sizes.forEach(function (size, index) {
      if (index % count === 0) {
        x = 0;
        y += Math.max.apply(null, sizes.slice(index, index + count).map(function (each) { return each[1]; })) + (index ? caption : 0);
      }
      found.push([x, y - size[1]]);
      x += size[0] + gap;
      wide = Math.max(wide, x - gap);
    });
    return { places: found, wide: wide, high: y + caption };
  }

  /* The drawings of what a drawing drives, on one sheet to one scale; what has no scale is as wide as the widest. Null where there is none. */
  window.drivenDrawings = function (moving, every, rows) {
    var found = moving.drives.map(function (drive) { return [drive, every.find(function (each) { return each.mechanism === drive.mechanism; })]; })
      .filter(function (pair) { return pair[1]; });
    if (!found.length) { return null; }
    var widest = Math.max.apply(null, found.map(function (pair) { return pair[1].scaled ? pair[1].room[2] : 0; })) || 1;
    var sizes = found.map(function (pair) {
      var room = pair[1].room, scale = pair[1].scaled ? 1 : widest / room[2];
      return [room[2] * scale, room[3] * scale, scale];
    });
    var gap = GAP * widest, best = found.map(function (pair, index) { return inRows(sizes, index + 1, gap, 3 * gap); }).reduce(function (one, other) {
      function off(each) { return Math.abs(Math.log(each.wide / each.high / WIDE)); }
      return off(other) < off(one) ? other : one;
    });
    var letter = CAPTION * Math.max(best.wide, best.high), sheet = svg("svg", { viewBox: [0, 0, best.wide, best.high].join(" "), role: "img", "aria-label": moving.title, "class": "moving driven" });
    var members = found.map(function (pair, index) {
      var own = window.movingDrawing(pair[1], rows, Math.max(best.wide, best.high) / 130 / sizes[index][2]), place = best.places[index], size = sizes[index];
      Object.entries({ x: place[0], y: place[1], width: size[0], height: size[1] }).forEach(function (each) { own.node.setAttribute(each[0], each[1]); });
      var caption = svg("text", { x: place[0] + size[0] / 2, y: place[1] + size[1] + 1.2 * letter, "font-size": letter, "class": "m-label center" });
      caption.append(pair[0].mechanism);
      sheet.append(own.node, caption);
      return function (x) {
        var turns = (x - pair[0].offset) / pair[0].period, range = pair[1].across.range;
        own.at(range[0] + (turns - Math.floor(turns)) * (range[1] - range[0]));
      };
    });
    return { node: sheet, at: function (x) { members.forEach(function (member) { member(x); }); } };
  };

  /* A button for a turn on its own, from where the cursor is, in six seconds; it stops where it is pressed again, or gone. */
  window.turnPlayer = function (text, span, place, go) {
    var button = document.createElement("button"), started = null, from = 0;
    button.type = "button";
    button.className = "r-play";
    button.append(text);
    function step(now) {
      if (started === null || !button.isConnected) { return; }
      started = started || now;
      var share = (now - started) / 6000;
      if (share >= 1) { stop(); go(from); return; }
      go(span[0] + (from - span[0] + share * (span[1] - span[0])) % (span[1] - span[0]));
      window.requestAnimationFrame(step);
    }
    function stop() { started = null; button.setAttribute("aria-pressed", "false"); }
    button.addEventListener("click", function () {
      if (started !== null) { stop(); return; }
      started = 0;
      from = place();
      button.setAttribute("aria-pressed", "true");
      window.requestAnimationFrame(step);
    });
    stop();
    return button;
  };
}());
