// A line chart based on uPlot: fast with thousands of points, themed colours, a text alternative. Part of the first load: a job
// page must not need its server again to show what it has received.

import { useEffect, useRef } from "react";
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { formatNumber } from "../lib/format";
import { token, useDarkScheme } from "./theme";

export interface ChartSeries {
  label: string;
  /** One value per x; null leaves a gap. */
  values: (number | null)[];
  /** Design token for the colour. */
  color: string;
  stepped?: boolean;
  /** Points only, without a line between them. */
  points?: boolean;
  dashed?: boolean;
  /** Connects points across gaps, for series that share x with others. */
  spanGaps?: boolean;
  width?: number;
}

interface Props {
  /** Text alternative. */
  summary: string;
  x: number[];
  xLabel: string;
  yLabel: string;
  series: ChartSeries[];
  /** x positions of thin vertical lines. */
  marks?: number[];
  height?: number;
  legend?: boolean;
  /** Ticks of x at whole numbers only: x counts something. */
  counted?: boolean;
  /** A logarithmic y axis; values must be above 0. */
  logarithmic?: boolean;
}

// eslint-disable-next-line @typescript-eslint/no-unsafe-enum-assignment -- uPlot declares the enum but exports no value
const LOGARITHMIC = 3 as uPlot.Scale.Distr;

/** Distances between ticks, whole numbers. */
const WHOLE = Array.from({ length: 10 }, (_, power) => [1, 2, 5].map((digit) => digit * 10 ** power)).flat();

function axis(label: string, size: number): uPlot.Axis {
  const line = { stroke: token("grid"), width: 1 };
  return {
    label,
    labelSize: 22,
    labelFont: "12px system-ui, sans-serif",
    font: "12px system-ui, sans-serif",
    size,
    stroke: token("muted"),
    grid: line,
    ticks: { ...line, size: 4 },
    values: (_plot, splits) => splits.map((value: number | null) => (value === null ? "" : formatNumber(value))),
  };
}

function line(series: ChartSeries): uPlot.Series {
  const color = token(series.color);
  const stepped = series.stepped === true ? uPlot.paths.stepped?.({ align: 1 }) : undefined;
  return {
    label: series.label,
    stroke: color,
    width: series.points === true ? 0 : (series.width ?? 2),
    ...(stepped ? { paths: stepped } : {}),
    spanGaps: series.spanGaps === true,
    ...(series.dashed === true ? { dash: [6, 5] } : {}),
    points: series.points === true ? { show: true, size: 7, fill: color, stroke: color } : { show: false },
    value: (_plot, value: number | null) => formatNumber(value),
  };
}

function drawMarks(marks: readonly number[]) {
  return (plot: uPlot) => {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = token("border-strong");
    ctx.globalAlpha = 0.45;
    ctx.setLineDash([3, 4]);
    ctx.beginPath();
    for (const mark of marks) {
      const at = plot.valToPos(mark, "x", true);
      ctx.moveTo(at, bbox.top);
      ctx.lineTo(at, bbox.top + bbox.height);
    }
    ctx.stroke();
    ctx.restore();
  };
}

export function Chart({ summary, x, xLabel, yLabel, series, marks, height = 240, legend = true, counted = false, logarithmic = false }: Props) {
  const host = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const shownMarks = useRef<readonly number[]>([]);
  const dark = useDarkScheme();
  const shape = series.map((each) => `${each.label}|${each.color}`).join("\n");

  const latest = useRef(series);
  useEffect(() => {
    latest.current = series;
    shownMarks.current = marks ?? [];
  });

  useEffect(() => {
    const element = host.current;
    if (element === null) return undefined;
    const chart = new uPlot(
      {
        width: Math.max(200, element.clientWidth),
        height,
        legend: { show: legend, live: true },
        cursor: { y: false, drag: { x: false, y: false } },
        scales: { x: { time: false }, y: logarithmic ? { distr: LOGARITHMIC, log: 10 } : {} },
        axes: [{ ...axis(xLabel, 40), ...(counted ? { incrs: WHOLE } : {}) }, axis(yLabel, 58)],
        series: [{ label: xLabel, value: (_plot, value: number | null) => formatNumber(value) }, ...latest.current.map(line)],
        hooks: { drawClear: [(self: uPlot) => drawMarks(shownMarks.current)(self)] },
      },
      [[], ...latest.current.map(() => [])],
      element,
    );
    plot.current = chart;
    const observer = new ResizeObserver(() => chart.setSize({ width: Math.max(200, element.clientWidth), height }));
    observer.observe(element);
    return () => {
      observer.disconnect();
      chart.destroy();
      plot.current = null;
    };
  }, [shape, xLabel, yLabel, height, legend, counted, logarithmic, dark]);

  useEffect(() => {
    plot.current?.setData([x, ...series.map((each) => each.values)]);
  }, [x, series, marks, shape, xLabel, yLabel, height, legend, counted, logarithmic, dark]);

  return <div ref={host} className="chart" role="img" aria-label={summary} style={{ minHeight: height }} />;
}
