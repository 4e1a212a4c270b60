/* Where the names of a diagram's levels stand: above their lines at its right end, else below, else further left, so that none stands
   over another while there is room, nor on another's line. In pixels: `levels` are {y, width of the name}, `box` the diagram (left, top,
   width, height), `letters` how high a line of text is. Each level gets {x, y}: the left end of its name, and its baseline. */
window.levelNames = function (levels, box, letters) {
  "use strict";
  var gap = letters / 3, taken = [], places = [];
  function isOnName(x, y, level) {
    return taken.some(function (other) {
      return x < other.x + other.width + gap && other.x < x + level.width + gap && Math.abs(y - other.y) < letters;
    });
  }
  function isOnLine(y, level) {
    return levels.some(function (other) { return other !== level && other.y > y - letters && other.y < y; });
  }
  function place(level) {
    var right = box.left + box.width - level.width - 2 * gap, above = level.y - gap, below = level.y + letters;
    var inside = [above, below].filter(function (y) { return y - letters >= box.top && y <= box.top + box.height; });
    var found = null, clear = inside.filter(function (y) { return !isOnLine(y, level); });
    [clear, inside].forEach(function (heights) {
      for (var x = right; x >= box.left && !found; x -= letters) {
        var free = heights.filter(function (y) { return !isOnName(x, y, level); });
        found = free.length ? { x: x, y: free[0] } : null;
      }
    });
    return found || { x: right, y: inside.length ? inside[0] : level.y - box.top < letters ? below : above };
  }
  levels.map(function (level, index) { return index; }).sort(function (a, b) { return levels[a].y - levels[b].y; }).forEach(function (index) {
    places[index] = place(levels[index]);
    taken.push({ x: places[index].x, y: places[index].y, width: levels[index].width });
  });
  return places;
};
