//! `lumbre devices`: what can render here, and which one `auto` takes.

use crate::exit::{Code, Failure};
use crate::flags::devices::DevicesArgs;
use crate::memory::human;
use crate::{console, memory};
use lumbre::{Device, DeviceInfo, DeviceKind, Devices};
use serde_json::json;

/// Runs the command.
pub(crate) fn run(args: &DevicesArgs) -> Result<Code, Failure> {
    let devices = lumbre::devices();
    // `auto` always takes something.
    let (auto, why) = devices.choose(&Device::Auto).map_err(|e| Failure::new(Code::Bug, e))?;
    let report = Report { devices, auto, why };
    console::result(if args.json { report.json() } else { report.text() })?;
    Ok(Code::Done)
}

/// What is printed.
struct Report {
    devices: Devices,
    auto: usize,
    why: String,
}

impl Report {
    fn text(&self) -> String {
        let asked: Vec<String> = self.devices.list.iter().map(|d| d.device.to_string()).collect();
        let width = asked.iter().map(String::len).max().unwrap_or(0);
        let mut lines = Vec::new();
        for (i, (d, asked)) in self.devices.list.iter().zip(&asked).enumerate() {
            let mark = if i == self.auto { '*' } else { ' ' };
            lines.push(format!("{mark} {asked:width$}  {}", d.name));
            let detail = |text: String| format!("{:1$}{text}", "", width + 4);
            lines.push(detail(format!("{}, {}", kind(d.kind), memory_of(d))));
            lines.extend(d.driver.iter().map(|driver| detail(format!("driver: {driver}"))));
            if !d.lacks.is_empty() {
                lines.push(detail(format!("cannot draw, lacks: {}", d.lacks.join(", "))));
            }
        }
        lines.extend(self.devices.problem.iter().map(|problem| format!("no GPU: {problem}")));
        lines.push(format!("* {}", self.why));
        lines.join("\n")
    }

    fn json(&self) -> String {
        let device = |d: &DeviceInfo| {
            json!({
                "device": d.device.to_string(),
                "kind": kind(d.kind),
                "name": d.name,
                "driver": d.driver,
                "memory": bytes(d),
                "lacks": d.lacks,
            })
        };
        let list: Vec<_> = self.devices.list.iter().map(device).collect();
        let auto = &self.devices.list[self.auto];
        json!({
            "devices": list,
            "no_gpu": self.devices.problem,
            "auto": { "device": auto.device.to_string(), "why": self.why },
        })
        .to_string()
    }
}

/// Bytes of its memory; of the CPU, what is free.
fn bytes(d: &DeviceInfo) -> Option<u64> {
    if d.kind == DeviceKind::Cpu { memory::available() } else { d.memory }
}

fn memory_of(d: &DeviceInfo) -> String {
    match (d.kind, bytes(d)) {
        (DeviceKind::Cpu, Some(free)) => format!("{} of memory free", human(free)),
        (DeviceKind::Cpu, None) => "memory not known".into(),
        (_, Some(all)) => format!("{} of memory", human(all)),
        (_, None) => "memory of the machine".into(),
    }
}

fn kind(kind: DeviceKind) -> &'static str {
    match kind {
        DeviceKind::DiscreteGpu => "discrete GPU",
        DeviceKind::IntegratedGpu => "integrated GPU",
        DeviceKind::VirtualGpu => "virtual GPU",
        DeviceKind::OtherGpu => "GPU",
        DeviceKind::Software => "Vulkan driver on the CPU",
        DeviceKind::Cpu => "processors",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre::GpuChoice;

    fn report() -> Report {
        let gpu = |index, name: &str, memory, lacks: &[&str]| DeviceInfo {
            device: Device::Gpu(GpuChoice::Index(index)),
            kind: DeviceKind::DiscreteGpu,
            name: name.into(),
            driver: Some("Maker 580.1".into()),
            memory,
            lacks: lacks.iter().map(ToString::to_string).collect(),
        };
        let cpu = DeviceInfo {
            device: Device::Cpu,
            kind: DeviceKind::Cpu,
            name: "CPU (avx2, 2 threads)".into(),
            driver: None,
            memory: None,
            lacks: Vec::new(),
        };
        let old = gpu(0, "Old 9000", Some(3 << 29), &["acceleration structures", "scalar layout"]);
        let list = vec![cpu, old, gpu(1, "New 1", None, &[])];
        let devices = Devices { list, problem: None };
        let (auto, why) = devices.choose(&Device::Auto).unwrap();
        Report { devices, auto, why }
    }

    #[test]
    fn each_device_has_its_lines_and_one_is_marked() {
        let text = report().text();
        let said: Vec<&str> = text.lines().collect();
        assert_eq!(said[0], "  cpu    CPU (avx2, 2 threads)");
        assert!(said[1].starts_with("         processors, "));
        assert_eq!(
            said[2..],
            [
                "  gpu:0  Old 9000",
                "         discrete GPU, 1.5 GiB of memory",
                "         driver: Maker 580.1",
                "         cannot draw, lacks: acceleration structures, scalar layout",
                "* gpu:1  New 1",
                "         discrete GPU, memory of the machine",
                "         driver: Maker 580.1",
                "* auto: the best GPU that traces rays",
            ]
        );
    }

    #[test]
    fn json_says_the_same() {
        let line: serde_json::Value = serde_json::from_str(&report().json()).unwrap();
        assert_eq!(line["devices"].as_array().unwrap().len(), 3);
        assert_eq!(line["devices"][1]["lacks"][1], "scalar layout");
        assert_eq!(line["devices"][1]["memory"], 3u64 << 29);
        assert_eq!(line["devices"][2]["driver"], "Maker 580.1");
        assert_eq!((&line["auto"]["device"], &line["no_gpu"]), (&"gpu:1".into(), &serde_json::Value::Null));
    }
}
