"""What a comparison, an ablation and a sweep leave in files: one declaration for who writes and who reads."""
