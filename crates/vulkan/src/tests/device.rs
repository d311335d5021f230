//! Opening, uploading, running out, losing.

use super::{gpu, silent};
use crate::{Buffer, Gpu, Options, Purpose, Specialisation, Upload, VulkanError, Wanted, adapters};

const HASH: &[u8] = include_bytes!("../../../shaders/spirv/twins/hash.comp.spv");

#[test]
fn adapters_are_listed_with_what_they_are() {
    let Some(gpu) = gpu() else { return };
    let all = adapters().unwrap();
    let same = all.iter().find(|a| a.name == gpu.adapter().name).expect("the open one is listed");
    assert!(same.missing.is_empty() && same.vulkan >= [1, 2, 0] && same.memory > 0);
    assert!(!same.driver.is_empty() && !same.driver_version.is_empty());
    let error = Gpu::open(&Wanted::Named("no such thing".into()), Options::default()).unwrap_err();
    assert!(matches!(error, VulkanError::NoSuchDevice { .. }), "{error}");
    silent(&gpu);
}

/// Several chunks up and down again, at an offset.
#[test]
fn what_goes_up_comes_down() {
    let Some(gpu) = gpu() else { return };
    let content: Vec<u32> = (0..20 << 20).map(|i: u32| i.wrapping_mul(0x9e37_79b9)).collect();
    let bytes: &[u8] = bytemuck::cast_slice(&content);
    let size = bytes.len() as u64 + 64;
    let there = Buffer::new(&gpu, "there", size, Purpose::Data).unwrap();
    let back = Buffer::new(&gpu, "back", size, Purpose::Readback).unwrap();
    let mut upload = Upload::new(&gpu);
    upload.write(&there, 64, bytes).unwrap();
    upload.write(&there, 0, &[7; 64]).unwrap();
    upload.finish().unwrap();
    gpu.run("a copy", |c| {
        c.copy((&there, 0), (&back, 0), size);
        Ok(())
    })
    .unwrap();
    assert!(back.read()[64..] == *bytes && back.read()[..64] == [7; 64]);
    assert_eq!(there.address() % 256, 0);
    silent(&gpu);
}

/// What a device made is gone with it, twenty times over.
#[test]
fn nothing_leaks() {
    let Some(gpu) = gpu() else { return };
    let before = gpu.memory();
    for _ in 0..20 {
        let kernel = gpu.kernel(HASH, &[0; 100], &Specialisation::new()).unwrap();
        assert_eq!(kernel.run::<[u32; 2], [u32; 2]>(&[[1, 2]; 1000]).unwrap().len(), 1000);
        let _kept = Buffer::new(&gpu, "kept", 1 << 20, Purpose::Data).unwrap();
        assert!(gpu.memory().pieces > before.pieces);
    }
    let after = gpu.memory();
    assert_eq!((after.pieces, after.allocated), (before.pieces, before.allocated));
    silent(&gpu);
}

/// Ten thousand submissions, two under way at a time, take what two take.
#[test]
fn submissions_do_not_add_up() {
    let Some(gpu) = gpu() else { return };
    let buffer = Buffer::new(&gpu, "filled", 64, Purpose::Data).unwrap();
    let before = gpu.memory();
    let mut last = None;
    for word in 0..10_000 {
        let pending = gpu.submit("filling", |c| {
            c.fill(&buffer, word);
            Ok(())
        });
        drop(last.replace(pending.unwrap()));
    }
    drop(last);
    assert_eq!(crate::gpu::lock(&gpu.0.idle).len(), 2);
    let after = gpu.memory();
    assert_eq!((after.pieces, after.reserved), (before.pieces, before.reserved));
    silent(&gpu);
}

#[test]
fn too_much_is_an_error_with_numbers() {
    let Some(gpu) = gpu() else { return };
    let error = Buffer::new(&gpu, "a huge thing", 1 << 50, Purpose::Data).unwrap_err();
    assert!(matches!(error, VulkanError::TooLarge { needed, .. } if needed == 1 << 50), "{error}");
    // Piece by piece until it is out.
    gpu.limit_memory(300 << 20);
    let hold = |_| Buffer::new(&gpu, "a piece", 64 << 20, Purpose::Data);
    let error = (0..5).map(hold).collect::<Result<Vec<_>, _>>().unwrap_err();
    assert!(
        matches!(&error, VulkanError::OutOfMemory { needed, available, .. } if needed > available),
        "{error}"
    );
    // It goes on afterwards.
    Buffer::new(&gpu, "a small thing", 1000, Purpose::Data).unwrap();
    silent(&gpu);
}

/// A lost device is an error each time from then on, and is closed in peace.
#[test]
fn a_lost_device_is_an_error() {
    let Some(gpu) = gpu() else { return };
    let kernel = gpu.kernel(HASH, &[0; 4], &Specialisation::new()).unwrap();
    let run = || kernel.run::<[u32; 2], [u32; 2]>(&[[1, 2]; 10]);
    gpu.lose_after(3);
    assert!(run().is_ok());
    assert_eq!(run().unwrap_err(), VulkanError::DeviceLost);
    assert_eq!(run().unwrap_err(), VulkanError::DeviceLost);
    silent(&gpu);
}

/// The layer listens, to synchronisation too: two writes without a barrier between them are a message.
#[test]
fn a_missing_barrier_is_a_message() {
    let Some(gpu) = gpu().filter(Gpu::validates) else { return };
    let buffer = Buffer::new(&gpu, "written twice", 256, Purpose::Data).unwrap();
    let fill = |barrier: bool| {
        gpu.run("two writes", |c| {
            c.fill(&buffer, 1);
            if barrier {
                c.barrier();
            }
            c.fill(&buffer, 2);
            Ok(())
        })
        .unwrap();
    };
    fill(true);
    silent(&gpu);
    fill(false);
    let messages = gpu.messages();
    assert!(messages.iter().any(|m| m.contains("SYNC-HAZARD-WRITE-AFTER-WRITE")), "{messages:?}");
}
