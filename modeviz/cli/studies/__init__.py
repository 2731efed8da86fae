"""The commands on studies: `modeviz study log|export|diff|backup|note|check`."""
