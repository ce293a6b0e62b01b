#include "client/plot/html.h"

#include "client/plot/svg.h"

namespace trc::plot {
namespace {

constexpr const char* style = R"(
body { margin: 0; font: 14px Helvetica, Arial, sans-serif; color: #222; }
header { padding: 8px 14px; border-bottom: 1px solid #ccc; }
header label { margin-right: 16px; white-space: nowrap; }
svg { display: block; width: 100vw; height: calc(100vh - 44px); cursor: grab; }
)";

constexpr const char* script = R"(
const svg = document.querySelector('svg');
svg.setAttribute('preserveAspectRatio', 'xMidYMid meet');
const box = svg.viewBox.baseVal;
const home = [box.x, box.y, box.width, box.height];
const layers = [['programmed', 'programmed contour'], ['lead', 'leads'],
  ['replaced', 'as programmed, replaced'], ['masked', 'masked or removed'], ['warning', 'warnings'],
  ['path', 'compensated path'], ['transition', 'transition blocks'], ['arrows', 'arrows'],
  ['tool', 'tool'], ['numbers', 'block numbers'], ['grid', 'grid']];
for (const [name, text] of layers) {
  const groups = svg.querySelectorAll('g.' + name);
  if (!groups.length) continue;
  const label = document.createElement('label');
  const check = document.createElement('input');
  const show = () => groups.forEach(g => g.style.display = check.checked ? '' : 'none');
  check.type = 'checkbox';
  check.checked = name !== 'numbers' || document.body.dataset.numbers === 'on';
  check.onchange = show;
  show();
  label.append(check, ' ' + text);
  document.querySelector('header').append(label);
}
for (const shape of svg.querySelectorAll('path, circle, line'))
  shape.setAttribute('vector-effect', 'non-scaling-stroke');
const scale = () => Math.max(box.width / svg.clientWidth, box.height / svg.clientHeight);
svg.addEventListener('wheel', event => {
  event.preventDefault();
  const factor = Math.exp(event.deltaY * 0.0015);
  const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(
      svg.getScreenCTM().inverse());
  box.x = at.x - (at.x - box.x) * factor;
  box.y = at.y - (at.y - box.y) * factor;
  box.width *= factor;
  box.height *= factor;
}, {passive: false});
svg.addEventListener('pointermove', event => {
  if (!(event.buttons & 1)) return;
  box.x -= event.movementX * scale();
  box.y -= event.movementY * scale();
});
svg.addEventListener('dblclick', () => [box.x, box.y, box.width, box.height] = home);
)";

}  // namespace

std::string to_html(const Picture& picture, bool numbers) {
  const std::string document = to_svg(picture, {.numbers = true});
  std::string page =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>";
  page += escaped(picture.title) + "</title>\n<style>" + style + "</style>\n</head>\n";
  page +=
      std::string("<body data-numbers=\"") + (numbers ? "on" : "off") + "\">\n<header></header>\n";
  // The XML declaration does not belong into a page.
  page += document.substr(document.find("<svg"));
  page += std::string("<script>") + script + "</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace trc::plot
