#pragma once
// Style sheet of the report. Curve colours are those of Okabe and Ito (2008), which colour-blind
// readers can tell apart; lighter ones of the same hues on dark ground.
namespace floatframe {

inline constexpr const char* report_style = R"css(
:root {
  --ground: #ffffff; --ink: #1c2126; --soft: #59636e; --line: #d5dae0; --grid: #e8ebef;
  --panel: #f6f7f9;
  --c0: #0072b2; --c1: #d55e00; --c2: #008a64; --c3: #b4558c; --bad: #a4161a; --bad-ground: #fdecec;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ground: #14171a; --ink: #e6e9ec; --soft: #9aa5b0; --line: #3a424b; --grid: #262c32;
    --panel: #1c2126;
    --c0: #56b4e9; --c1: #f0883e; --c2: #2fc79b; --c3: #e29ac4; --bad: #ff9c9c;
    --bad-ground: #3b1719;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
main { max-width: 1000px; margin: 0 auto; padding: 40px 24px 32px; }
h1 { font-size: 34px; line-height: 1.2; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 20px; margin: 40px 0 12px; }
h3 { font-size: 16px; margin: 0; overflow-wrap: anywhere; }
.kind { margin: 0 0 4px; color: var(--soft); }
.failed { margin: 24px 0; padding: 14px 18px; border-left: 5px solid var(--bad); border-radius: 4px;
  background: var(--bad-ground); color: var(--bad); overflow-wrap: anywhere; white-space: pre-line;
  }
.warned { margin: 24px 0; padding: 14px 18px; border-left: 5px solid var(--soft);
  border-radius: 4px;
  background: var(--panel); overflow-wrap: anywhere; }
.warned ul { margin: 6px 0 0; padding-left: 20px; }
.headline { display: grid; grid-template-columns: repeat(auto-fit, minmax(180px, 1fr)); gap: 1px;
  margin: 28px 0 0;
  background: var(--line); border: 1px solid var(--line); border-radius: 8px; overflow: hidden; }
.headline div { background: var(--panel); padding: 14px 18px; }
.headline b { display: block; font-size: 24px; line-height: 1.3;
  font-variant-numeric: tabular-nums; }
.headline span { color: var(--soft); font-size: 14px; }
figure { margin: 0 0 24px; }
figcaption { display: flex; flex-wrap: wrap; gap: 4px 24px; align-items: baseline;
  justify-content: space-between;
  padding: 0 2px 4px; }
.legend { display: flex; flex-wrap: wrap; gap: 2px 18px; list-style: none; margin: 0; padding: 0;
  font-size: 14px; }
.key { width: 34px; height: 10px; margin-right: 7px; }
.plot { overflow-x: auto; }
.plot svg { display: block; width: 100%; min-width: 560px; height: auto; }
.grid { stroke: var(--grid); stroke-width: 1; }
.axis { fill: none; stroke: var(--soft); stroke-width: 1; }
.tick { fill: var(--soft); font-size: 13px; font-variant-numeric: tabular-nums; }
.title { fill: var(--ink); font-size: 14px; }
.curve { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
.c0 { stroke: var(--c0); }
.c1 { stroke: var(--c1); stroke-dasharray: 9 4; }
.c2 { stroke: var(--c2); stroke-dasharray: 2.5 3; }
.c3 { stroke: var(--c3); stroke-dasharray: 9 3 2.5 3; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(400px, 100%), 1fr));
  gap: 0 48px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 15px; }
th, td { padding: 6px 14px 6px 0; border-bottom: 1px solid var(--line); text-align: right;
  vertical-align: top;
  font-variant-numeric: tabular-nums; white-space: nowrap; }
th { font-weight: 500; color: var(--soft); }
th:first-child { text-align: left; }
th:last-child, td:last-child { padding-right: 0; }
.facts th, .facts td { white-space: normal; overflow-wrap: anywhere; }
sup { line-height: 0; font-size: 75%; }
.note, footer { color: var(--soft); font-size: 14px; }
footer { margin-top: 48px; padding-top: 14px; border-top: 1px solid var(--line); }
@media print {
  main { max-width: none; padding: 0; }
  figure, section { break-inside: avoid; }
}
)css";

}  // namespace floatframe
