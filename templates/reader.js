/* What a reader does with a report on a screen: find, filter, read curves at the cursor, copy, light or dark. All of it is there
   without this script too, as printed. It fetches nothing, and writes texts as texts, never as markup. */
(function () {
  "use strict";
  var root = document.documentElement;
  var data = JSON.parse(document.getElementById("reader-data").textContent);
  var words = document.getElementById("reader-words").dataset;
  var all = function (pattern, within) { return Array.from((within || document).querySelectorAll(pattern)); };

  function make(name, attributes, children) {
    var node = document.createElement(name);
    Object.keys(attributes || {}).forEach(function (key) { node.setAttribute(key, attributes[key]); });
    [].concat(children === undefined ? [] : children).forEach(function (child) { node.append(child); });
    return node;
  }

  function say(text) { document.getElementById("reader-told").textContent = text; }

  /* A text in pieces, its symbols (F_t, S) apart: {text, role}. */
  function pieces(text) {
    var found = [], start = 0, sign = /(?<![\p{L}\p{N}.])(\p{L}{1,2}['′]?)_([\p{L}\p{N},]{1,9})|^(\p{L}['′]?)$|(?<![\p{L}\p{N}])(\p{L}['′]?)(?= [=<>≤≥])/gu;
    text.replace(sign, function (whole, base, below, lone, before, at) {
      if (at > start) { found.push({ text: text.slice(start, at), role: "" }); }
      found.push({ text: base || lone || before, role: "sign" });
      if (below) { found.push({ text: below, role: "below" }); }
      start = at + whole.length;
      return whole;
    });
    if (start < text.length) { found.push({ text: text.slice(start), role: "" }); }
    return found;
  }

  function said(text) {
    return pieces(text).map(function (piece) {
      return piece.role === "sign" ? make("i", { "class": "sy" }, piece.text) : piece.role === "below" ? make("sub", {}, piece.text) : piece.text;
    });
  }

  /* A number as the report prints it: to four digits, none finer than means something in its unit (the power of ten of the last one,
     and how many a small number keeps), nor than the page knows it (a power of ten). */
  function printed(value, finest, known) {
    if (value === null || !isFinite(value)) { return "–"; }
    if (value === 0) { return "0"; }
    var power = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(4)))));
    var digits = Math.min(4, finest ? Math.max(power - finest[0] + 1, finest[1]) : 4, known === undefined ? 4 : power - known + 1);
    if (digits < 1) { return "0"; }
    power = Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))));
    var scaled = power < -4 || power >= 6, shown = scaled ? (value / Math.pow(10, power)).toFixed(digits - 1) : value.toFixed(Math.max(digits - 1 - power, 0));
    var parts = shown.replace("-", "\u2212").split(".");
    if (parts[0].replace("\u2212", "").length > 4) { parts[0] = parts[0].replace(/(?<=\d)(?=(\d{3})+$)/g, "\u202f"); }
    return parts.join(data.decimal) + (scaled ? "\u2009×\u200910" + String(power).replace(/./g, function (c) { return c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]; }) : "");
  }

  function withUnit(text, unit) { return text + (unit && !/^[°′″]/.test(unit) ? "\u00a0" : "") + (unit || ""); }

  /* ---- light and dark ---- */
  var redraw = [];
  function theme() {
    var button = document.getElementById("reader-theme"), kept = null;
    try { kept = localStorage.getItem("diecut-report-theme"); } catch (refused) { kept = null; } // a page of a file may have no storage
    var dark = window.matchMedia("(prefers-color-scheme: dark)");
    function isDark() { return root.dataset.theme ? root.dataset.theme === "dark" : dark.matches; }
    function show() {
      button.setAttribute("aria-pressed", String(isDark()));
      redraw.forEach(function (draw) { draw(); });
    }
    if (kept === "dark" || kept === "light") { root.dataset.theme = kept; }
    button.addEventListener("click", function () {
      root.dataset.theme = isDark() ? "light" : "dark";
      try { localStorage.setItem("diecut-report-theme", root.dataset.theme); } catch (refused) { say(""); } // it then holds for this page alone
      show();
    });
    dark.addEventListener("change", show);
    show();
  }

  /* ---- where the reader is ---- */
  function places() {
    var box = document.querySelector("nav.toc details"), wide = window.matchMedia("(min-width: 62.01rem)");
    var entries = {}, heads = [], chapter = null;
    function unfold() { box.open = wide.matches; }
    wide.addEventListener("change", unfold);
    unfold();
    all("nav.toc li").forEach(function (item) {
      if (item.classList.contains("d1")) { chapter = item; }
      item.chapter = chapter;
      var link = item.querySelector("a"), target = document.getElementById(link.getAttribute("href").slice(1));
      if (target) { entries[target.id] = item; heads.push(target); }
    });
    all("nav.toc a").forEach(function (link) { link.addEventListener("click", function () { box.open = wide.matches; }); });
    var current = null, waiting = false;
    function look() {
      waiting = false;
      var now = heads[0];
      heads.some(function (head) {
        if (head.getBoundingClientRect().top > 80) { return true; }
        now = head;
        return false;
      });
      if (window.innerHeight + window.scrollY >= root.scrollHeight - 2 && window.scrollY) { now = heads[heads.length - 1]; }
      if (!now || now === current) { return; }
      if (current) { entries[current.id].querySelector("a").removeAttribute("aria-current"); }
      current = now;
      var item = entries[now.id];
      item.querySelector("a").setAttribute("aria-current", "location");
      all("nav.toc li.d2").forEach(function (other) { other.hidden = other.chapter !== item.chapter; });
      if (wide.matches) {
        var list = document.querySelector("nav.toc"), place = item.getBoundingClientRect();
        if (place.top < 160 || place.bottom > list.clientHeight - 40) { list.scrollTop += place.top - list.clientHeight / 3; }
      }
    }
    window.addEventListener("scroll", function () {
      if (!waiting) { waiting = true; window.requestAnimationFrame(look); }
    }, { passive: true });
    look();
  }

  function goTo(node) {
    for (var fold = node.closest("details:not([open])"); fold; fold = fold.parentElement.closest("details:not([open])")) { fold.open = true; }
    node.scrollIntoView({ block: "center" });
    node.classList.add("found");
    window.setTimeout(function () { node.classList.remove("found"); }, 2500);
  }

  /* ---- search over headings, quantities and symbols ---- */
  function flat(text) { return text.toLowerCase().replace(/[_\s\u2009\u202f\u00a0]+/g, " ").trim(); }

  function found() {
    var known = [], chapter = "";
    all("main h2[id], main h3[id], main table.quantities tbody tr, main table.inputs tbody tr, main table.keys td.k1, main table.keys td.k2, main table.parts th, main .eq .lead, main figcaption").forEach(function (node) {
      var title = node, more = "";
      if (node.tagName === "H2") { chapter = node.textContent.trim().split(" ")[0]; }
      if (node.tagName === "TR") {
        title = node.cells[0];
        var sign = node.cells[1], value = node.querySelector(".num"), unit = node.querySelector(".unit");
        more = (sign && sign.querySelector(".sy") ? sign.textContent.trim() + (value ? " = " : "") : "") + (value ? withUnit(shown(value), unit ? shown(unit) : "") : "");
      }
      var text = title.textContent.replace(/\s+/g, " ").trim();
      if (text) { known.push({ node: node, text: text, more: more, chapter: chapter, sought: flat(text + " " + more), isHead: /^H/.test(node.tagName) }); }
    });
    return known;
  }

  function search() {
    var field = document.getElementById("reader-search"), list = document.getElementById("reader-found"), known = null;
    function results(text) {
      known = known || found();
      var parts = flat(text).split(" ").filter(Boolean);
      if (!parts.length) { return []; }
      var hits = known.filter(function (entry) { return parts.every(function (part) { return entry.sought.includes(part); }); });
      return hits.sort(function (a, b) { return rank(a, text) - rank(b, text); });
    }
    function rank(entry, text) {
      var sign = entry.more.split(" = ")[0];
      return (flat(sign) === flat(text) || flat(sign) === flat(text).replace(/ /g, "") ? -2 : 0) + (entry.isHead ? -1 : 0);
    }
    function show() {
      var hits = field.value.trim() ? results(field.value) : [];
      list.replaceChildren.apply(list, hits.slice(0, 40).map(function (hit) {
        var button = make("button", { type: "button" }, [make("span", { "class": "hn" }, hit.chapter), " " + hit.text, hit.more ? make("span", { "class": "sub" }, hit.more) : ""]);
        button.addEventListener("click", function () { goTo(hit.node); });
        return make("li", {}, button);
      }));
      list.hidden = !hits.length;
      say(field.value.trim() ? words.hits.replace("{n}", hits.length) : "");
      document.getElementById("reader-hits").textContent = field.value.trim() ? words.hits.replace("{n}", hits.length) : "";
    }
    function step(event) {
      var buttons = all("button", list), at = buttons.indexOf(document.activeElement);
      if (event.key === "Escape") { field.value = ""; show(); field.focus(); return; }
      if (event.key !== "ArrowDown" && event.key !== "ArrowUp") { return; }
      event.preventDefault();
      var next = at + (event.key === "ArrowDown" ? 1 : -1);
      (next < 0 ? field : buttons[Math.min(next, buttons.length - 1)] || field).focus();
    }
    field.addEventListener("input", show);
    field.closest(".tools").addEventListener("keydown", step);
    document.addEventListener("keydown", function (event) {
      if (event.key === "/" && !/^(INPUT|SELECT|TEXTAREA)$/.test(document.activeElement.tagName) && !event.ctrlKey && !event.metaKey) {
        event.preventDefault();
        field.focus();
      }
    });
  }

  /* ---- filter of checks ---- */
  function filter() {
    var box = document.getElementById("all-checks");
    if (!box) { return; }
    var tools = box.querySelector(".filters"), rows = all("tbody tr", box), told = box.querySelector(".filtered");
    var kind = tools.querySelector("select"), text = tools.querySelector("input"), buttons = all("button[data-status]", tools);
    tools.hidden = false;
    function show() {
      var states = buttons.filter(function (b) { return b.getAttribute("aria-pressed") === "true"; }).map(function (b) { return b.dataset.status; });
      var sought = flat(text.value).split(" ").filter(Boolean), count = 0;
      rows.forEach(function (row) {
        var content = flat(row.textContent);
        var fits = (!states.length || states.includes(row.dataset.status)) && (!kind.value || row.dataset.kind === kind.value)
          && sought.every(function (part) { return content.includes(part); });
        row.hidden = !fits;
        count += fits ? 1 : 0;
      });
      told.textContent = words.shown.replace("{n}", count).replace("{total}", rows.length);
    }
    buttons.forEach(function (button) {
      button.addEventListener("click", function () {
        button.setAttribute("aria-pressed", String(button.getAttribute("aria-pressed") !== "true"));
        show();
      });
    });
    kind.addEventListener("change", show);
    text.addEventListener("input", show);
    show();
  }

  /* ---- numbers with their units to the clipboard ---- */
  function shown(cell) {
    var copy = cell.cloneNode(true);
    all(".copy, .sub, .mark", copy).forEach(function (part) { part.remove(); });
    return copy.textContent.trim();
  }

  function plainNumber(text) {
    return text.replace(/\u2212/g, "-").replace(/[\u202f](?=\d)/g, "").replace(/\s*×\s*10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, function (whole, power) {
      return "e" + power.replace(/./g, function (c) { return c === "⁻" ? "-" : String("⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)); });
    }).replace(/\u00a0/g, " ");
  }

  function copied(text) {
    function old() {
      var field = make("textarea", { "class": "off", "aria-hidden": "true", tabindex: "-1" }), before = document.activeElement;
      field.value = text;
      document.body.append(field);
      field.select();
      var done = document.execCommand("copy");
      field.remove();
      before.focus();
      return done ? Promise.resolve() : Promise.reject(new Error("refused"));
    }
    return navigator.clipboard ? navigator.clipboard.writeText(text).catch(old) : old();
  }

  function copies() {
    all("main table.quantities, main table.inputs, main table.keys").forEach(function (table) {
      var buttons = [];
      all("td.num", table).forEach(function (cell) {
        var unit = cell.nextElementSibling, text = withUnit(shown(cell), unit && unit.classList.contains("unit") ? shown(unit) : "");
        var button = make("button", { type: "button", "class": "copy", tabindex: buttons.length ? "-1" : "0", "aria-label": words.copy.replace("{text}", text), title: words.copy.replace("{text}", text) });
        button.copies = plainNumber(text);
        buttons.push(button);
        cell.append(button);
      });
      table.addEventListener("click", function (event) {
        var button = event.target.closest(".copy");
        if (!button) { return; }
        copied(button.copies).then(function () {
          say(words.copied.replace("{text}", button.copies));
          button.classList.add("done");
          window.setTimeout(function () { button.classList.remove("done"); }, 1200);
        }, function () { say(words.refused.replace("{text}", button.copies)); });
      });
      table.addEventListener("keydown", function (event) {
        var at = buttons.indexOf(event.target), next = at + { ArrowDown: 1, ArrowUp: -1 }[event.key];
        if (at < 0 || !buttons[next]) { return; }
        event.preventDefault();
        event.target.tabIndex = -1;
        buttons[next].tabIndex = 0;
        buttons[next].focus();
      });
    });
  }

  /* ---- tables on a narrow screen: each cell says what it is ---- */
  /* the words of a head with the unit; the symbol, which has no index in plain text, only where it stands alone */
  function named(head) {
    var sign = head.querySelector(".whole");
    if (sign && sign.textContent.trim() !== head.textContent.trim()) {
      all("i, sub", sign).forEach(function (part) { part.remove(); });
      sign.textContent = (/,[^,]*$/.exec(sign.textContent) || [""])[0];
    }
    return head.textContent.replace(/\s+,/g, ",").replace(/\s+/g, " ").trim();
  }

  function labels() {
    all("main table:not(.changes)").forEach(function (table) {
      var heads = table.tHead ? Array.from(table.tHead.rows[0].cells) : [];
      if (!heads.length) { return; }
      all("tbody tr", table).forEach(function (row) {
        var place = 0;
        Array.from(row.cells).forEach(function (cell) {
          var head = heads[place];
          if (head && place && cell.textContent.trim()) {
            var copy = head.cloneNode(true);
            all(".sub, .vh", copy).forEach(function (part) { part.remove(); });
            cell.dataset.label = head.title || named(copy);
          }
          place += cell.colSpan;
        });
      });
      table.classList.add("labelled");
    });
  }

  /* ---- what scrolls in a box of its own can be reached by the keyboard; boxes are measured where the page has nothing else to do ---- */
  var measuring = 0;
  function reach() {
    var boxes = all("main .math, main .why, main .remark, main .scroll"), own = measuring += 1;
    var wait = window.requestIdleCallback || function (go) { window.setTimeout(go, 20); };
    function some() {
      if (own !== measuring) { return; }
      var part = boxes.splice(0, 12);
      var wide = part.map(function (box) { // by what it holds: what is far away is not laid out by itself; measured at once, then changed at once
        var edge = box.getBoundingClientRect().right + 1;
        return box.scrollWidth > box.clientWidth + 1 || Array.from(box.children).some(function (part) { return part.getBoundingClientRect().right > edge; });
      });
      part.forEach(function (box, index) {
        if (wide[index]) { box.tabIndex = 0; } else { box.removeAttribute("tabindex"); }
      });
      if (boxes.length) { wait(some); } else { root.dataset.reached = "all"; }
    }
    delete root.dataset.reached;
    wait(some);
  }

  /* ---- curves read at the cursor ---- */
  var groups = [];
  /* Where the cursor of a group begins: where the last of its diagrams and drawings does, as all of them have a value there. */
  function beginning(group) {
    var panels = Object.keys(data.figures).reduce(function (found, number) { return found.concat(data.figures[number].panels); }, []);
    return Math.max.apply(null, panels.concat(data.moving).filter(function (each) { return each.group === group; })
      .map(function (each) { return each.across.range[0]; }));
  }
  data.turns.forEach(function (turn, index) { groups.push({ place: beginning(index), members: [], turn: turn, moving: data.moving.filter(function (each) { return each.group === groups.length; }) }); });
  var LOOKS = [["accent", [], 1.9], ["ink", [7, 3], 1.5], ["soft", [8, 2, 2, 2], 1.5], ["ink", [2, 2], 1.5], ["ink", [], 0.9], ["accent", [13, 3], 1.8], ["soft", [8, 2, 2, 2, 2, 2], 1.5], ["accent", [4, 2], 1.9]];

  function colour(name) { return getComputedStyle(root).getPropertyValue("--r-" + name).trim(); }

  /* The height of a line at a place: on the straight piece between its points, the right one of a jump; null beside it. */
  function height(line, x) {
    var xs = data.rows[line.x], ys = data.rows[line.y], low = 0, high = xs.length - 1;
    var hair = 1e-5 * (xs[high] - xs[low]); // by which rounded places may lie beside the ends of the range
    if (x < xs[low] - hair || x > xs[high] + hair) { return null; }
    x = Math.max(xs[low], Math.min(x, xs[high]));
    while (high - low > 1) {
      var middle = (low + high) >> 1;
      if (xs[middle] <= x) { low = middle; } else { high = middle; }
    }
    if (ys[low] === null || ys[high] === null) { return xs[low] === x ? ys[low] : xs[high] === x ? ys[high] : null; }
    return xs[high] === xs[low] ? ys[high] : ys[low] + (ys[high] - ys[low]) * (x - xs[low]) / (xs[high] - xs[low]);
  }

  /* Lines with places of their own over common ones. A jump has two points at its place: the second one stands a hair farther. */
  function joined(lines, hair) {
    var tables = lines.map(function (line) {
      var last = -Infinity;
      return [data.rows[line.x].map(function (x) { last = x > last ? x : last + hair; return last; }), data.rows[line.y]];
    });
    return tables.every(function (table) { return table[0] === tables[0][0]; }) && tables.length === 1 ? tables[0] : window.uPlot.join(tables);
  }

  /* A place as a member counts it, whose range may lie whole turns off. */
  function within(x, range, turn) {
    var low = range[0] - 1e-9 * turn, high = range[1] + 1e-9 * turn;
    if (!turn || (x >= low && x <= high)) { return x; }
    var moved = x + turn * Math.ceil((low - x) / turn);
    return moved <= high ? moved : x;
  }

  function move(group, x) {
    group.place = x;
    group.members.forEach(function (member) { member.at(within(x, member.range, group.turn)); });
  }

  /* A text on a chart, clear of the lines below it. */
  function write(context, text, x, y) {
    context.save();
    context.textAlign = "left"; context.textBaseline = "alphabetic"; // the chart's axes leave theirs
    context.strokeStyle = colour("paper"); context.lineWidth = 3 * window.devicePixelRatio; context.lineJoin = "round"; context.setLineDash([]);
    pieces(text).forEach(function (piece) {
      var below = piece.role === "below", size = below ? 8.5 : 11;
      context.font = (piece.role === "sign" ? "italic " : "") + size * window.devicePixelRatio + "px 'Report Sans', sans-serif";
      context.strokeText(piece.text, x, y + (below ? 3 * window.devicePixelRatio : 0));
      context.fillText(piece.text, x, y + (below ? 3 * window.devicePixelRatio : 0));
      x += context.measureText(piece.text).width;
    });
    context.restore();
  }

  function wide(context, text) {
    context.font = 11 * window.devicePixelRatio + "px 'Report Sans', sans-serif";
    return context.measureText(text.replace(/_/g, "")).width;
  }

  /* What stands behind and on the lines: named ranges, levels, upright lines, marked points. */
  function behind(u, panel) {
    var c = u.ctx, box = u.bbox, px = window.devicePixelRatio;
    c.save();
    c.beginPath(); c.rect(box.left, box.top, box.width, box.height); c.clip();
    panel.spans.forEach(function (span) {
      var from = u.valToPos(span.from, "x", true), to = u.valToPos(span.to, "x", true);
      c.fillStyle = colour("pale"); c.fillRect(from, box.top, to - from, box.height);
      c.fillStyle = colour("soft");
      var room = wide(c, span.text);
      if (room < to - from) { write(c, span.text, (from + to - room) / 2, box.top + box.height - 5 * px); }
    });
    c.restore();
  }

  function before(u, panel) {
    var c = u.ctx, box = u.bbox, px = window.devicePixelRatio;
    c.save();
    c.beginPath(); c.rect(box.left, box.top, box.width, box.height); c.clip();
    c.strokeStyle = c.fillStyle = colour("ink"); c.lineWidth = px;
    var heights = panel.levels.map(function (level) { return { y: u.valToPos(level.y, "y", true), width: wide(c, level.text) }; });
    heights.forEach(function (level) {
      c.setLineDash([8 * px, 3 * px]); c.beginPath(); c.moveTo(box.left, level.y); c.lineTo(box.left + box.width, level.y); c.stroke();
    });
    window.levelNames(heights, box, 13 * px).forEach(function (place, index) { write(c, panel.levels[index].text, place.x, place.y); });
    panel.uprights.forEach(function (line) {
      var x = u.valToPos(line.x, "x", true), room = wide(c, line.text);
      c.setLineDash([4 * px, 3 * px]); c.beginPath(); c.moveTo(x, box.top); c.lineTo(x, box.top + box.height); c.stroke();
      write(c, line.text, x + room + 6 * px > box.left + box.width ? x - room - 3 * px : x + 3 * px, box.top + 12 * px);
    });
    c.setLineDash([]);
    panel.marks.forEach(function (mark) {
      var x = u.valToPos(mark.x, "x", true), y = u.valToPos(mark.y, "y", true);
      c.fillStyle = colour("paper"); c.beginPath(); c.arc(x, y, 3.5 * px, 0, 7); c.fill(); c.stroke();
      c.fillStyle = colour("ink");
      var room = wide(c, mark.text);
      write(c, mark.text, Math.max(box.left + 2, Math.min(x - room / 2, box.left + box.width - room - 2)), y - box.top < 20 * px ? y + 16 * px : y - 8 * px);
    });
    c.restore();
  }

  function swatch(index, filled) {
    var look = LOOKS[index % LOOKS.length], node = make("span", { "class": "swatch" + (filled ? " area" : ""), "aria-hidden": "true" });
    if (!filled) {
      var line = document.createElementNS("http://www.w3.org/2000/svg", "svg"), path = document.createElementNS("http://www.w3.org/2000/svg", "path");
      line.setAttribute("viewBox", "0 0 30 6"); line.setAttribute("width", "30"); line.setAttribute("height", "6");
      path.setAttribute("d", "M0 3H30"); path.setAttribute("fill", "none"); path.setAttribute("class", "s-" + look[0]);
      path.setAttribute("stroke-width", look[2]); path.setAttribute("stroke-dasharray", look[1].join(" ") || "none");
      line.append(path);
      node.append(line);
    }
    return node;
  }

  /* One diagram: its title, its lines with their heights at the cursor, and the chart. */
  function diagram(panel, box, tall) {
    var group = groups[panel.group], lines = panel.fills.concat(panel.lines), told = [];
    var head = make("p", { "class": "r-head" }, [make("strong", {}, panel.title), panel.unit ? ", " + panel.unit : ""]);
    lines.forEach(function (line, index) {
      var value = make("b", { "class": "r-value" }, "–");
      told.push(value);
      head.append(make("span", { "class": "r-line" }, [swatch(index - panel.fills.length, index < panel.fills.length), make("span", {}, said(line.label || panel.title)), " ", value]));
    });
    var place = make("div", { "class": "r-chart", role: "img", "aria-label": panel.title });
    box.append(head, place);
    var known = Math.floor(Math.log10(Math.max(Math.abs(panel.range[0]), Math.abs(panel.range[1])))) - 4; // rows have five digits
    var span = panel.across.range, hair = (span[1] - span[0]) * 1e-9;
    var member = { chart: null, at: null, isReady: false, range: span };
    function draw() {
      if (member.chart) { member.chart.destroy(); }
      member.isReady = false;
      var axis = { stroke: colour("ink"), font: "11px 'Report Sans', sans-serif", grid: { stroke: colour("grid"), width: 1 }, ticks: { stroke: colour("grid"), width: 1, size: 4 }, gap: 3 };
      var figures = function (u, values) { return values.map(function (v) { return String(Number(v.toPrecision(8))).replace("-", "\u2212").replace(".", data.decimal); }); };
      member.chart = new window.uPlot({
        width: Math.max(box.clientWidth, 240), height: tall, legend: { show: false },
        scales: { x: { time: false, range: function (u, low, high) { return low === null ? span : [low, high]; }, auto: true }, y: { range: panel.range } },
        axes: [
          Object.assign({}, axis, { size: 26, values: figures, incrs: panel.across.unit === "°" ? [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 90, 120, 180, 360, 720, 1440] : undefined }),
          Object.assign({}, axis, { size: 52, values: figures, space: 26 })
        ],
        cursor: { y: false, drag: { x: true, y: false }, points: { size: 6 } },
        series: [{}].concat(lines.map(function (line, index) {
          var area = index < panel.fills.length, look = LOOKS[Math.max(index - panel.fills.length, 0) % LOOKS.length];
          return { stroke: colour(area ? "soft" : look[0]), width: area ? 0.6 : look[2], dash: area ? [] : look[1], fill: area ? colour("pale") : undefined, fillTo: 0, points: { show: false } };
        })),
        hooks: {
          ready: [function () { member.isReady = true; if (group.place !== null) { member.at(within(group.place, span, group.turn)); } }],
          drawClear: [function (u) { behind(u, panel); }], draw: [function (u) { before(u, panel); }],
          setCursor: [function (u) {
            if (u.cursor.event && u.cursor.left >= 0) { move(group, Math.max(span[0], Math.min(u.posToVal(u.cursor.left, "x"), span[1]))); }
          }]
        }
      }, joined(lines, hair), place);
      member.chart.over.addEventListener("mouseleave", function () { // the chart hides its cursor then
        if (group.place !== null) { window.setTimeout(function () { member.at(within(group.place, span, group.turn)); }); }
      });
    }
    member.at = function (x) {
      told.forEach(function (value, index) {
        var y = height(lines[index], x);
        value.textContent = y === null ? "–" : withUnit(printed(y, panel.finest, known), panel.unit);
      });
      if (member.isReady && !(member.chart.cursor.event && member.chart.over.matches(":hover"))) {
        member.chart.setCursor({ left: member.chart.valToPos(x, "x"), top: 0 }, false);
      }
    };
    group.members.push(member);
    redraw.push(draw);
    new ResizeObserver(function () {
      if (box.clientWidth && member.chart && Math.abs(box.clientWidth - member.chart.width) > 2) { member.chart.setSize({ width: box.clientWidth, height: tall }); }
    }).observe(box);
    draw();
  }

  /* The slider below the diagrams of one abscissa: the cursor for the keyboard and for fingers. */
  function slider(panel, box) {
    var group = groups[panel.group], span = panel.across.range, across = panel.across;
    var output = make("output", {}, ""), input = make("input", { type: "range", min: span[0], max: span[1], step: (span[1] - span[0]) / 720, "aria-label": across.title });
    input.value = span[0];
    input.addEventListener("input", function () { move(group, Number(input.value)); });
    group.members.push({ range: span, at: function (x) {
      var text = withUnit(printed(Number(x.toPrecision(4))).replace(/(?<=[.,]\d*)0+$|[.,]0+$/, ""), across.unit);
      input.value = x;
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
    } });
    box.append(make("label", { "class": "r-slide" }, [make("span", {}, [across.title + " "].concat(said(across.symbol))), input, output]));
  }

  /* A drawing that moves with the cursor. */
  function mover(moving, box) { follows(window.movingDrawing(moving, data.rows), moving, box); }

  function follows(drawing, moving, box) {
    box.append(drawing.node);
    groups[moving.group].members.push({ range: moving.across.range, at: drawing.at });
  }

  function beside(group, box) {
    if (!group.moving.length) { return; }
    var row = make("div", { "class": "r-moving" });
    group.moving.forEach(function (moving) { mover(moving, row); });
    box.append(row);
  }

  function movable(moving) {
    var figure = document.getElementById("fig-" + moving.figure), box = make("div", { "class": "reading large" }), group = groups[moving.group];
    figure.querySelector(".fig").after(box);
    mover(moving, box);
    if (moving.shapes.some(function (shape) { return shape.text; })) { inPlace(figure, box); } // with all its words it says what the printed one does
    var driven = window.drivenDrawings(moving, data.moving, data.rows), span = moving.across.range;
    if (driven) { follows(driven, moving, box); }
    slider(moving, box);
    box.append(window.turnPlayer(words.play, span, function () { return within(group.place, span, group.turn); }, function (x) { move(group, x); }));
    move(group, group.place);
  }

  /* What is read stands in the place of what was printed, which a button shows. */
  function inPlace(figure, box) {
    var button = make("button", { type: "button", "class": "as-printed", "aria-pressed": "false" }, words.printed);
    box.after(button);
    button.addEventListener("click", function () {
      var printed = figure.classList.toggle("printed");
      button.setAttribute("aria-pressed", String(printed));
    });
    figure.classList.add("read");
  }

  function readable(number) {
    var figure = document.getElementById("fig-" + number), svg = figure.querySelector(".fig"), panels = data.figures[number].panels, isBeside = data.figures[number].beside;
    var box = make("div", { "class": "reading" });
    var tall = isBeside ? 130 : Math.max(130, Math.min(240, svg.clientHeight / panels.length - 30));
    figure.insertBefore(box, isBeside ? svg.nextSibling : svg);
    panels.forEach(function (panel, index) {
      diagram(panel, box, tall);
      if (!panels[index + 1] || panels[index + 1].group !== panel.group) { slider(panel, box); beside(groups[panel.group], box); }
    });
    if (!isBeside) {
      inPlace(figure, box);
    }
    panels.forEach(function (panel) {
      move(groups[panel.group], groups[panel.group].place);
    });
  }

  function readings() {
    var watch = new IntersectionObserver(function (entries) {
      entries.forEach(function (entry) {
        if (!entry.isIntersecting) { return; }
        watch.unobserve(entry.target);
        readable(entry.target.id.slice(4));
      });
    }, { rootMargin: "300px" });
    Object.keys(data.figures).forEach(function (number) { watch.observe(document.getElementById("fig-" + number)); });
  }

  root.classList.add("scripted");
  all(".tools").forEach(function (box) { box.hidden = false; });
  labels();
  copies();
  theme();
  places();
  search();
  filter();
  readings();
  data.moving.forEach(movable);
  reach();
  window.addEventListener("resize", reach);
  document.addEventListener("toggle", reach, true); // what is unfolded is measured then
}());
