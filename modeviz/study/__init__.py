"""What an engineer types: one vehicle, its mount rates, and all there is to ask of them."""
